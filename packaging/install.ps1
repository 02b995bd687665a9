# Installs the program jostle for Windows into %LOCALAPPDATA%\Programs\jostle, or into $env:JOSTLE_INSTALL_DIR:
#   powershell -c "irm https://github.com/jostle-sim/jostle/releases/latest/download/install.ps1 | iex"
# $env:JOSTLE_VERSION chooses a version such as v0.1.0.
$ErrorActionPreference = "Stop"

$releases = "https://github.com/jostle-sim/jostle/releases"
$from = if ($env:JOSTLE_VERSION) { "$releases/download/$env:JOSTLE_VERSION" } else { "$releases/latest/download" }
$to = if ($env:JOSTLE_INSTALL_DIR) { $env:JOSTLE_INSTALL_DIR } else { "$env:LOCALAPPDATA\Programs\jostle" }
$folder = "jostle-x86_64-pc-windows-msvc"
$work = Join-Path ([IO.Path]::GetTempPath()) ([IO.Path]::GetRandomFileName())
New-Item -ItemType Directory $work | Out-Null
try {
    foreach ($file in "$folder.zip", "$folder.zip.sha256") {
        Invoke-WebRequest "$from/$file" -OutFile "$work\$file" -UseBasicParsing
    }
    $expected = (Get-Content "$work\$folder.zip.sha256").Split(" ")[0]
    if ((Get-FileHash "$work\$folder.zip" -Algorithm SHA256).Hash -ne $expected) {
        throw "jostle: the checksum of $folder.zip is wrong; nothing was installed"
    }
    Expand-Archive "$work\$folder.zip" $work
    New-Item -ItemType Directory -Force $to | Out-Null
    Copy-Item "$work\$folder\jostle.exe" "$to\jostle.exe" -Force
    # The engine of exported live pages, which the program looks for beside itself.
    if (Test-Path "$work\$folder\jostle.wasm.gz") {
        Copy-Item "$work\$folder\jostle.wasm.gz" "$to\jostle.wasm.gz" -Force
    }
    & "$to\jostle.exe" --version
    if (($env:PATH -split ";") -notcontains $to) {
        Write-Output "$to is not on your PATH; add it, or run $to\jostle.exe"
    }
} finally {
    Remove-Item -Recurse -Force $work
}
