#!/usr/bin/env bash
# Brings what building and running Londra needs beside Rust and is not there yet, on Debian and Ubuntu:
# a C linker, a Vulkan loader with a software driver, and the libraries a window opens through.
# Elsewhere it only says what is missing. It does nothing where nothing is missing.
set -euo pipefail

fail() {
    echo "setup: $*" >&2
    exit 1
}

command -v cargo > /dev/null || fail "cargo is not there: install Rust from https://rustup.rs and open a new shell."

# macOS and Windows bring everything themselves.
[ "$(uname -s)" = Linux ] || exit 0

# Read once: a pipe that ends early would count as a failure.
libraries=$(PATH="$PATH:/sbin:/usr/sbin" ldconfig -p 2> /dev/null || true)

# has_library libvulkan.so.1
has_library() {
    case "$libraries" in
        *"$1 "*) return 0 ;;
    esac
    return 1
}

# What is missing, as packages of Debian and Ubuntu.
missing=()
command -v cc > /dev/null || missing+=(gcc libc6-dev)
has_library libvulkan.so.1 || missing+=(libvulkan1)
# The software driver is wanted even beside a real one: the tests compare pictures drawn with it.
has_library libvulkan_lvp.so || compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' > /dev/null ||
    missing+=(mesa-vulkan-drivers)
has_library libEGL.so.1 || missing+=(libegl1)
has_library libX11.so.6 || missing+=(libx11-6)
has_library libX11-xcb.so.1 || missing+=(libx11-xcb1)
has_library libXcursor.so.1 || missing+=(libxcursor1)
has_library libXi.so.6 || missing+=(libxi6)
has_library libxkbcommon.so.0 || missing+=(libxkbcommon0)
has_library libxkbcommon-x11.so.0 || missing+=(libxkbcommon-x11-0)
has_library libwayland-client.so.0 || missing+=(libwayland-client0)

[ ${#missing[@]} -gt 0 ] || exit 0

command -v apt-get > /dev/null ||
    fail "missing (by their names on Debian): ${missing[*]}. Install them with this system's package manager."

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo > /dev/null ||
        fail "missing: ${missing[*]}. As root: apt-get install ${missing[*]}"
    as_root=(sudo)
fi

install() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

echo "setup: installing ${missing[*]}"
if ! install; then
    # A fresh machine has no package lists, or old ones.
    "${as_root[@]}" apt-get update && install ||
        fail "the packages could not be installed: ${missing[*]}. Is there a network? By hand: apt-get install ${missing[*]}"
fi
