# Installs the program jostle for Windows into %LOCALAPPDATA%\Programs\jostle, or into $env:JOSTLE_INSTALL_DIR:
#   powershell -c "irm https://github.com/jostle-sim/jostle/releases/latest/download/install.ps1 | iex"
# $env:JOSTLE_VERSION chooses a version such as v0.1.0.

# In a block of its own: the settings of the shell that runs it stay as they are.
& {
    $ErrorActionPreference = "Stop"
    # The progress bar of Windows PowerShell 5 slows downloads down, and old ones offer no TLS 1.2 by themselves.
    $ProgressPreference = "SilentlyContinue"
    [Net.ServicePointManager]::SecurityProtocol = [Net.ServicePointManager]::SecurityProtocol -bor [Net.SecurityProtocolType]::Tls12

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
        $expected = ((Get-Content "$work\$folder.zip.sha256" -TotalCount 1) -split "\s+")[0]
        if ((Get-FileHash -LiteralPath "$work\$folder.zip" -Algorithm SHA256).Hash -ne $expected) {
            throw "jostle: the checksum of $folder.zip is wrong; nothing was installed"
        }
        Expand-Archive -LiteralPath "$work\$folder.zip" -DestinationPath $work
        New-Item -ItemType Directory -Force $to | Out-Null
        # Beside the old program first, so that it is replaced whole or not at all. A program that runs cannot be replaced.
        Copy-Item -LiteralPath "$work\$folder\jostle.exe" "$to\jostle-new.exe" -Force
        & "$to\jostle-new.exe" --version
        if ($LASTEXITCODE -ne 0) { throw "jostle: the program does not start on this machine; the old one was kept" }
        Move-Item -LiteralPath "$to\jostle-new.exe" "$to\jostle.exe" -Force
        # The engine of exported live pages, which the program looks for beside itself.
        if (Test-Path -LiteralPath "$work\$folder\jostle.wasm.gz") {
            Copy-Item -LiteralPath "$work\$folder\jostle.wasm.gz" "$to\jostle.wasm.gz" -Force
        }
        if (($env:PATH -split ";") -notcontains $to) {
            Write-Output "$to is not on your PATH; add it, or run $to\jostle.exe"
        }
    } finally {
        Remove-Item -Recurse -Force -LiteralPath $work
        if (Test-Path -LiteralPath "$to\jostle-new.exe") { Remove-Item -Force -LiteralPath "$to\jostle-new.exe" }
    }
}
