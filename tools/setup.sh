#!/bin/sh
# Sets up .venv beside the sources: tools/setup.sh run | test
# Run again it does only what is missing or has changed.
set -eu
cd "$(dirname "$0")/.."
purpose=${1:-run}

say() { printf '%s\n' "$*" >&2; }

find_python() {
    for name in ${PYTHON:-} python3.13 python3.12 python3.11 python3 python; do
        if command -v "$name" >/dev/null 2>&1 &&
            "$name" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 14))' >/dev/null 2>&1; then
            printf '%s' "$name"
            return
        fi
    done
    say "facemorph needs Python 3.11, 3.12 or 3.13, and none is on the PATH. Install one, or name it: make run PYTHON=/path/to/python3"
    exit 1
}

make_environment() {
    [ -x .venv/bin/python ] && .venv/bin/python -m pip --version >/dev/null 2>&1 && return
    python=$(find_python)
    say "Making .venv with $python ..."
    rm -rf .venv
    if ! "$python" -m venv .venv >/dev/null 2>&1; then
        rm -rf .venv
        [ -f /etc/debian_version ] && install_debian python3-venv && "$python" -m venv .venv && return
        say "$python cannot make a virtual environment. On Debian and Ubuntu: sudo apt-get install python3-venv"
        exit 1
    fi
}

install_package() {
    extras=$([ "$purpose" = test ] && echo '[dev]' || echo '')
    stamp=.venv/facemorph-$purpose.stamp
    key=$(cat pyproject.toml constraints.txt hatch_build.py | cksum)
    [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$key" ] && return
    say "Installing facemorph and what it needs into .venv ..."
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable ".$extras"
    printf '%s' "$key" >"$stamp"
}

has_library() {
    .venv/bin/python -c 'import ctypes, sys; ctypes.CDLL(sys.argv[1])' "$1" >/dev/null 2>&1
}

install_debian() {
    command -v apt-get >/dev/null 2>&1 || return 1
    if [ "$(id -u)" = 0 ]; then root=""
    elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then root="sudo -n"
    else return 1
    fi
    say "Installing system packages: $* ..."
    DEBIAN_FRONTEND=noninteractive $root apt-get install -y -q "$@" >/dev/null 2>&1 && return 0
    $root apt-get update -q >/dev/null 2>&1 || return 1
    DEBIAN_FRONTEND=noninteractive $root apt-get install -y -q "$@" >/dev/null 2>&1
}

system_libraries() {
    [ "$(uname -s)" = Linux ] || return 0
    missing=""
    for pair in libEGL.so.1:libegl1 libGL.so.1:libgl1 libX11.so.6:libx11-6 libXext.so.6:libxext6; do
        has_library "${pair%%:*}" || missing="$missing ${pair##*:}"
    done
    # Mesa's drivers are loaded by EGL itself; without them it has no renderer on a machine without a GPU.
    find /usr/lib /usr/lib64 -name 'swrast_dri.so' -o -name 'libgallium*.so' 2>/dev/null | grep -q . ||
        missing="$missing libgl1-mesa-dri"
    if [ "$purpose" = test ]; then
        has_library libOSMesa.so.8 || has_library libOSMesa.so.6 || missing="$missing libosmesa6"
        command -v Xvfb >/dev/null 2>&1 || missing="$missing xvfb"
        command -v xdotool >/dev/null 2>&1 || missing="$missing xdotool"
    fi
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2086 # the names are meant to be split
    if [ -f /etc/debian_version ] && install_debian $missing; then return 0; fi
    say "OpenGL libraries may be missing ($(echo $missing)). Debian, Ubuntu: sudo apt-get install libegl1 libgl1 libgl1-mesa-dri libx11-6 libxext6;" \
        "Fedora: sudo dnf install mesa-libEGL mesa-libGL mesa-dri-drivers libX11 libXext;" \
        "Arch: sudo pacman -S mesa libx11 libxext; macOS and Windows: nothing beyond the graphics driver."
}

make_environment
install_package
system_libraries
