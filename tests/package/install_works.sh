#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs into a private root, as configured and as if configured for every other host, and checks
# where the plugin, the tool and the licence are:
# install_works.sh BUILD_DIR RELEASE SCALAR TOOL MESHLAB_LIBRARY_DIR WORK_DIR
#
# TOOL is empty if it is not built, MESHLAB_LIBRARY_DIR if the plugin's MeshLab is not installed.
set -euo pipefail

build=$1 release=$2 scalar=$3 tool=$4 library_dir=$5 work=$6
plugin=libfilter_tracked_mcf.so
home=/home/somebody
user_plugins=VCG/MeshLab_64bit_fp/MeshLabExtraPlugins
rm -rf "$work"
mkdir -p "$work"

# Installs as cmake --install does. The component's name keeps the build folder's list of installed
# files that of the real installation. If $beside is set, a file of that name is there already.
run_install() { # NAME=VALUE...: other settings, or XDG_... in the environment
    local settings=(-DCMAKE_INSTALL_COMPONENT=Unspecified -DCMAKE_INSTALL_PREFIX=/usr/local
        -DTRACKED_MCF_USER_INSTALL=OFF -DTRACKED_MCF_PLUGIN_DIR=) setting
    local environment=(DESTDIR="$work/root" HOME="$home" XDG_DATA_HOME=)
    for setting in "$@"; do
        case $setting in
            XDG_*) environment+=("$setting") ;;
            *) settings+=("-D$setting") ;;
        esac
    done
    rm -rf "$work/root"
    [ -z "${beside:-}" ] || install -D "$0" "$work/root/$beside"
    env "${environment[@]}" cmake "${settings[@]}" -P "$build/cmake_install.cmake" \
        > "$work/log.txt" 2>&1
}
failures=0
fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s\n' "$*"
    cat "$work/log.txt"
}
goes_to() { # PLUGIN_DIR TOOL_DIR NAME=VALUE...
    local expected found
    expected=$({
        echo "$1/$plugin"
        [ -z "$tool" ] || printf '%s\n' "$2/$tool"{,_folder}
        printf '%s\n' "$(dirname "$2")/share/doc/filter_tracked_mcf"/{LICENSE,THIRD_PARTY.txt}
    } | sort)
    if ! run_install "${@:3}"; then
        fail "cannot install: ${*:3}"
        return
    fi
    found=$(cd "$work/root" && find . -type f | sed 's/^\.//' | sort)
    if [ "$found" = "$expected" ] &&
        ! readelf -d "$work/root/$1/$plugin" | grep -E 'RPATH|RUNPATH'; then
        echo "${*:3} -> ${found//$'\n'/ }"
    else
        fail "${*:3}: found $found rather than $expected"
    fi
}
is_refused() { # MESSAGE NAME=VALUE...
    if run_install "${@:2}" || ! tr -s '\n ' ' ' < "$work/log.txt" | grep -qF "$1" ||
        [ -n "$(find "$work/root" -name "$plugin")" ]; then
        fail "not refused with '$1': ${*:2}"
    else
        echo "${*:2}: refused, as expected"
    fi
}
warns_of() { # FILE NAME=VALUE...
    local beside=$1
    if run_install "${@:2}" && tr -d '\n ' < "$work/log.txt" | grep -qF "Removeit:$work/root$1"; then
        echo "${*:2}: warns of $1, as expected"
    else
        fail "no warning of $1: ${*:2}"
    fi
}

echo "== As configured: MeshLab $release, $scalar"
if [ "$scalar" = double ]; then
    goes_to "/usr/local/lib/pymeshlab-${release/.0/.}" /usr/local/bin
elif [ -n "$library_dir" ]; then
    goes_to "$library_dir/plugins" /usr/local/bin
elif [ "$release" = 2020.09 ]; then
    is_refused "looks for plugins in its own folder alone"
else
    goes_to "$home/.local/share/$user_plugins/$release" "$home/.local/bin"
fi

echo "== For every host"
old=(TRACKED_MCF_HOST=MeshLab TRACKED_MCF_HOST_RELEASE=2020.09)
new=(TRACKED_MCF_HOST=MeshLab TRACKED_MCF_HOST_RELEASE=2022.02)
python=(TRACKED_MCF_HOST=PyMeshLab TRACKED_MCF_HOST_RELEASE=2025.7)
here=MESHLAB_LIBRARY_DIR=/opt/meshlab elsewhere=MESHLAB_LIBRARY_DIR=
for_user=TRACKED_MCF_USER_INSTALL=ON
goes_to /opt/meshlab/plugins /usr/local/bin "${old[@]}" $here
goes_to /opt/meshlab/plugins /usr/local/bin "${new[@]}" $here
goes_to /opt/meshlab/plugins /opt/bin "${new[@]}" $here CMAKE_INSTALL_PREFIX=/opt
is_refused "no MeshLab of that release was found" "${old[@]}" $elsewhere
is_refused "asks for a user's" "${old[@]}" $here $for_user
for where in "$elsewhere" "$here $for_user"; do
    read -ra where <<< "$where"
    in_home=$home/.local/share/$user_plugins/2022.02
    goes_to "$in_home" "$home/.local/bin" "${new[@]}" "${where[@]}"
    goes_to "$in_home" /opt/bin "${new[@]}" "${where[@]}" CMAKE_INSTALL_PREFIX=/opt
    goes_to "/data/$user_plugins/2022.02" "$home/.local/bin" "${new[@]}" "${where[@]}" \
        XDG_DATA_HOME=/data
done
goes_to /usr/local/lib/pymeshlab-2025.7 /usr/local/bin "${python[@]}" $here
goes_to /opt/lib/pymeshlab-2025.7 /opt/bin "${python[@]}" $elsewhere CMAKE_INSTALL_PREFIX=/opt
goes_to "$home/.local/lib/pymeshlab-2025.7" "$home/.local/bin" "${python[@]}" $elsewhere $for_user
for host in "${old[*]}" "${new[*]}" "${python[*]}"; do
    read -ra host <<< "$host"
    goes_to /plugins /usr/local/bin "${host[@]}" $elsewhere TRACKED_MCF_PLUGIN_DIR=/plugins
done

if [ -n "$tool" ]; then
    echo "== The command for folders"
    run_install "${python[@]}" CMAKE_INSTALL_PREFIX=/opt
    "$(dirname "$0")/../cli/folder_test.py" "$work/root/opt/bin/$tool"{,_folder} ||
        fail "${tool}_folder does not smooth a folder"
fi

echo "== Beside another build"
for where in /opt/meshlab/plugins "$home/.local/share/$user_plugins/2022.02"; do
    warns_of "$where/libfilter_tracked_mcf-0.9.so" "${new[@]}" $here
    warns_of "$where/libfilter_tracked_mcf-0.9.so" "${new[@]}" $here $for_user
done
warns_of "/opt/meshlab/plugins/$plugin" "${new[@]}" $here $for_user
warns_of /plugins/libfilter_tracked_mcf-0.9.so "${old[@]}" $elsewhere TRACKED_MCF_PLUGIN_DIR=/plugins
beside=/opt/meshlab/plugins/$plugin run_install "${old[@]}" $here
! grep "another build" "$work/log.txt" || fail "a warning of the file that is replaced"
exit "$((failures > 0))"
