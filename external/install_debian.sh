#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages for a task: install_debian.sh TASK...
#
#   core         building the core: a compiler, CMake, Eigen
#   program      building the command-line program, too
#   plugin       building the MeshLab plugin, too, and MeshLab itself
#   package      packing it for Debian or for Python, too
#   python       building the Python package for NumPy arrays
#   demo         running the plugin without a screen and drawing pictures of surfaces
#   tests        building and running all tests
#   research     building and running tests/research, CGAL included
#   pymeshlab    external/pymeshlab.sh
#   windows      building for Windows and running tests in Wine
#   arm64        building for ARM64 and running tests in QEMU
#   checks       formatting, static analysis, sanitizers and coverage
#
# Runs apt only if a package is missing, with sudo unless run as root.
set -euo pipefail

packages_of() {
    case $1 in
        core) echo g++ make cmake libeigen3-dev ;;
        program) echo "$(packages_of core)" libcli11-dev libfast-float-dev nlohmann-json3-dev xz-utils ;;
        plugin) echo "$(packages_of program)" meshlab "$(libraries_recommended_by meshlab)" \
            qtbase5-dev libqt5opengl5-dev libglew-dev libglu1-mesa-dev ;;
        package) echo "$(packages_of plugin)" dpkg-dev file help2man python3 ;;
        python) echo "$(packages_of core)" python3-dev python3-venv ;;
        demo) echo "$(packages_of plugin)" xvfb xauth python3-vtk9 python3-numpy ;;
        tests) echo "$(packages_of package) $(packages_of python)" libgtest-dev libgmock-dev \
            xvfb xauth xdotool imagemagick debootstrap python3-numpy python3-matplotlib python3-nbclient \
            python3-ipykernel python3-cloudpickle python3-joblib python3-distributed ;;
        research) echo "$(packages_of program)" libcgal-dev libsuitesparse-dev meshlab "$(libraries_recommended_by meshlab)" \
            python3-matplotlib python3-scipy python3-vtk9 python3-numpy xvfb xauth ;;
        pymeshlab) echo python3-venv python3-numpy python3-matplotlib ;;
        windows) echo "$(packages_of program)" g++-mingw-w64-x86-64-posix googletest python3 wine wine64 ;;
        arm64) echo "$(packages_of program)" g++-aarch64-linux-gnu googletest python3 qemu-user ;;
        checks) echo g++-11 libc++-dev libc++abi-dev clang clang-format clang-tidy-22 libclang-rt-dev llvm git \
            valgrind libcgal-dev ;;
        *) echo "install_debian.sh: unknown task '$1'" >&2 && return 1 ;;
    esac
}

# On some Debians, meshlab only recommends libraries of its own plugins. If MeshLab cannot load one of
# its plugins, it does not load a user's plugins either.
libraries_recommended_by() {
    apt-cache show --no-all-versions "$1" 2> /dev/null | awk -F ', ' 'sub(/^Recommends: /, "") {
        for (i = 1; i <= NF; ++i) if ($i ~ /^lib/) { sub(/ .*/, "", $i); print $i } }'
}

is_installed() { dpkg-query -W -f '${db:Status-Status}\n' "$1" 2> /dev/null | grep -qx installed; }

# Images of Debian often have no package lists. The other scripts of this folder need them, too.
has_lists() { [ -n "$(apt-get indextargets 'Created-By: Packages')" ]; }

[ $# -gt 0 ] || { sed -n '/^# Installs/,/^$/s/^# \{0,1\}//p' "$0" >&2 && exit 2; }
if ! command -v apt-get > /dev/null; then
    echo "install_debian.sh: this system has no apt-get. Install the equivalents of these Debian" \
        "packages, then go on: $(for task in "$@"; do packages_of "$task"; done)" >&2
    exit 1
fi

as_root=()
[ "$(id -u)" = 0 ] || as_root=(sudo)
has_lists || "${as_root[@]}" apt-get -q update
missing=()
for task in "$@"; do
    packages=$(packages_of "$task")
    for package in $packages; do
        is_installed "$package" || missing+=("$package")
    done
done
[ ${#missing[@]} -gt 0 ] || exit 0
"${as_root[@]}" apt-get -q update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends \
    "${missing[@]}"
