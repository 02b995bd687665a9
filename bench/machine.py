"""The machine and the versions."""

import os
import platform
import subprocess

import programs


def said(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=20).stdout.strip()
    except OSError:
        return ""


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        return names[0] if names else platform.processor()
    except OSError:
        return platform.processor()


def describe():
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "system": platform.platform(terse=True),
        "load": round(os.getloadavg()[0], 2),
        "python": platform.python_version(),
        "jostle": said([programs.JOSTLE, "--version"]),
        "commit": said(["git", "describe", "--always", "--dirty"]),
        "rustc": said(["rustc", "--version"]),
    }
