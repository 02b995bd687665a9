#!/bin/sh
# Installs the program jostle for Linux or macOS into ~/.local/bin, or into $JOSTLE_INSTALL_DIR:
#   curl --proto '=https' -LsSf https://github.com/jostle-sim/jostle/releases/latest/download/install.sh | sh
# JOSTLE_VERSION chooses a version such as v0.1.0, JOSTLE_DOWNLOAD another place with the same files.
set -eu

main() {
    case "$(uname -s)-$(uname -m)" in
        Linux-x86_64) target=x86_64-unknown-linux-musl ;;
        Linux-aarch64 | Linux-arm64) target=aarch64-unknown-linux-musl ;;
        Darwin-x86_64) target=x86_64-apple-darwin ;;
        Darwin-arm64) target=aarch64-apple-darwin ;;
        *)
            echo "jostle: no program is built for $(uname -s) on $(uname -m); build it with: cargo install jostle-cli" >&2
            exit 1
            ;;
    esac
    releases=https://github.com/jostle-sim/jostle/releases
    if [ -n "${JOSTLE_DOWNLOAD:-}" ]; then
        from="$JOSTLE_DOWNLOAD"
    elif [ -n "${JOSTLE_VERSION:-}" ]; then
        from="$releases/download/$JOSTLE_VERSION"
    else
        from="$releases/latest/download"
    fi
    to="${JOSTLE_INSTALL_DIR:-$HOME/.local/bin}"
    work="$(mktemp -d)"
    trap 'rm -rf "$work"' EXIT
    archive="jostle-$target.tar.gz"
    for file in "$archive" "$archive.sha256"; do
        curl --fail --location --silent --show-error --output "$work/$file" "$from/$file" || {
            echo "jostle: $from/$file cannot be downloaded" >&2
            exit 1
        }
    done
    (
        cd "$work"
        if command -v sha256sum >/dev/null; then
            sha256sum --check --quiet "$archive.sha256"
        else
            shasum -a 256 --check --quiet "$archive.sha256"
        fi
    ) || {
        echo "jostle: the checksum of $archive is wrong; nothing was installed" >&2
        exit 1
    }
    tar -xzf "$work/$archive" -C "$work"
    mkdir -p "$to"
    # Beside the old program first, so that it is replaced whole or not at all.
    cp "$work/jostle-$target/jostle" "$to/.jostle-new"
    mv "$to/.jostle-new" "$to/jostle"
    # The engine of exported live pages, which the program looks for beside itself.
    if [ -f "$work/jostle-$target/jostle.wasm.gz" ]; then
        cp "$work/jostle-$target/jostle.wasm.gz" "$to/"
    fi
    "$to/jostle" --version
    case ":$PATH:" in
        *":$to:"*) ;;
        *) echo "$to is not on your PATH; add it, or run $to/jostle" ;;
    esac
}

# Everything is read before anything runs: a download that breaks off does nothing.
main
