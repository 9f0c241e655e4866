# SPDX-License-Identifier: Apache-2.0
# Sourced by ./brisance, ./test and .ci/run: gets the packages and builds. Says what it does on stderr, since stdout is the
# program's. Exit codes as in src/base/error.h: 1 the build failed, 4 something is missing that the user must provide.
#
#   BRISANCE_PRESET          a configure preset of CMakePresets.json (default: release)
#   BRISANCE_SKIP_PACKAGES   not empty: take the machine as it is, install nothing

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
preset=${BRISANCE_PRESET:-release}
build=$root/build/$preset
binary=$build/brisance
stamp=$build/setup.stamp
log=$root/build/setup.log

say() { printf '%s\n' "$*" >&2; }
fail() {
    local code=$1
    shift
    say "error: $*"
    exit "$code"
}

# True if the binary was built here (it knows where its materials are), from these sources, at this commit.
is_fresh() {
    local seen
    [[ -x $binary && -f $stamp ]] && seen=$(<"$stamp") && [[ $seen == "$root" ]] || return 1
    local watched=("$root/src" "$root/CMakeLists.txt" "$root/CMakePresets.json" "$root/tools/commit.cmake" "$root/tools/packages.txt")
    [[ -f $root/.git/logs/HEAD ]] && watched+=("$root/.git/logs/HEAD")
    [[ -z $(find "${watched[@]}" -newer "$stamp" -print -quit 2>&1) ]]
}

# packages SET...: the lines of packages.txt in these sets, as "package command".
packages() {
    local set package command
    while read -r set package command; do
        [[ " $* " == *" $set "* ]] && printf '%s %s\n' "$package" "$command"
    done < <(sed 's/#.*//' "$root/tools/packages.txt")
}

# missing SET...: the packages that are not there, unless their command is.
missing() {
    local package command installed
    installed=$(packages "$@" | cut -d' ' -f1 | xargs dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null)
    while read -r package command; do
        [[ $'\n'$installed$'\n' == *$'\n'"installed $package"$'\n'* ]] && continue
        [[ -n $command ]] && command -v "$command" >/dev/null && continue
        printf '%s\n' "$package"
    done < <(packages "$@")
}

# apt_get ARGUMENTS: as root, into the log.
apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300 "$@" </dev/null >>"$log" 2>&1
}

need_packages() {
    [[ -n ${BRISANCE_SKIP_PACKAGES:-} ]] && return
    local tool wanted=() as_root=()
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "This is not a Debian system. brisance needs what these Debian packages hold: $(packages "$@" | cut -d' ' -f1 | tr '\n' ' ')"
        for tool in $(packages build | cut -s -d' ' -f2); do
            [[ $tool == g++ ]] && command -v "${CXX:-c++}" >/dev/null && continue
            command -v "$tool" >/dev/null || fail 4 "there is no $tool on the PATH"
        done
        return
    fi
    mapfile -t wanted < <(missing "$@")
    ((${#wanted[@]})) || return 0

    local order="apt-get install --no-install-recommends ${wanted[*]}"
    if ((EUID != 0)); then
        if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
            as_root=(sudo -n)
        elif command -v sudo >/dev/null && [[ -t 0 && -t 2 ]]; then
            say "brisance needs packages that are not installed; sudo may ask for your password."
            sudo -v && as_root=(sudo)
        fi
        if ((${#as_root[@]} == 0)); then
            say "brisance needs packages that are not installed. An administrator must run:"
            say "    $order"
            fail 4 "${#wanted[@]} packages are missing (BRISANCE_SKIP_PACKAGES=1 goes on without them)"
        fi
    fi
    say "installing with apt-get: ${wanted[*]}"
    if ! apt_get install --no-install-recommends "${wanted[@]}"; then  # most often the lists are old, or there are none
        say "updating the package lists ..."
        apt_get update || say "apt-get update failed; trying with the lists that are there"
        if ! apt_get install --no-install-recommends "${wanted[@]}"; then
            tail -n 15 "$log" >&2
            fail 4 "apt-get could not install ${wanted[*]}; all of its output is in $log"
        fi
    fi
}

# logged COMMAND: into the log; on failure its end is shown and the script ends.
logged() {
    printf '+ %s\n' "$*" >>"$log"
    "$@" </dev/null >>"$log" 2>&1 && return
    head -n -25 "$log" | grep -E -m 8 '(^|[^a-z])error' >&2  # the first one is seldom at the end
    say "..."
    tail -n 25 "$log" >&2
    fail 1 "the build failed; all of its output is in $log"
}

# configure ON|OFF: with the tests or without. Tests that were once configured stay so.
configure() {
    local cache=$build/CMakeCache.txt arguments=() home=
    [[ -f $cache ]] && home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")
    if [[ $home == "$root" && -f $build/build.ninja ]]; then
        if [[ $1 == ON ]] && ! grep -q '^BRISANCE_TESTS:BOOL=ON' "$cache"; then
            arguments=(-DBRISANCE_TESTS=ON)
        elif [[ ! $root/CMakePresets.json -nt $build/build.ninja ]]; then
            return
        fi
    else
        arguments=("-DBRISANCE_TESTS=$1")
        [[ -n $home && $home != "$root" ]] && arguments+=(--fresh)  # the folder was moved or copied
    fi
    (cd "$root" && logged cmake --preset "$preset" "${arguments[@]}") || exit
}

# setup TARGET ON|OFF SET...: packages, configuration, build, one at a time on this folder.
setup() {
    local target=$1 tests=$2 started
    shift 2
    mkdir -p "$root/build" 2>/dev/null && [[ -w $root/build ]] || fail 4 "cannot write to $root/build"
    if command -v flock >/dev/null; then
        exec 9>"$root/build/setup.lock"
        flock -n 9 || { say "waiting for another build in $root/build ..."; flock 9; }
    fi
    if [[ $target != brisance ]] || ! is_fresh; then
        : >"$log"
        need_packages "$@"
        if [[ -x $binary ]]; then say "building what changed ..."; else say "building brisance (about a minute) ..."; fi
        configure "$tests"
        printf '%s\n' "$root" >"$stamp.new"  # dated before the build, so that an edit made meanwhile counts as newer
        logged cmake --build "$build" --target "$target"
        mv "$stamp.new" "$stamp"
    fi
    exec 9>&-
}
