#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Looks for mistakes without running anything: cppcheck over src (half a minute), clang-tidy with the profile .clang-tidy over files.
#
#   tools/lint.sh            cppcheck alone
#   tools/lint.sh --changed  and clang-tidy over the sources changed since the last commit
#   tools/lint.sh --all      and clang-tidy over all of src (ten minutes)
#   tools/lint.sh FILE...    and clang-tidy over these
#
# Exit codes: 0 nothing found, 1 something, 77 a tool is missing. Needs a build (build/release/compile_commands.json): ./brisance --version
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root" || exit 1
[[ $1 == -h || $1 == --help ]] && { sed -n '3,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0; }
need() { command -v "$1" >/dev/null || { echo "$1 is not here; on Debian: apt install $1"; exit 77; }; }
need cppcheck

case $1 in
    "") files=() ;;
    --all) mapfile -t files < <(find src -name '*.cpp' | sort) ;;
    --changed) mapfile -t files < <(git diff --name-only HEAD -- 'src/*.cpp') ;;
    *) files=("$@") ;;
esac
if ((${#files[@]})); then
    need clang-tidy
    [[ -f build/release/compile_commands.json ]] || { echo "build first: ./brisance --version"; exit 77; }
fi

failed=0
# What is suppressed was looked at: cppcheck 2.10 does not know std::string_view (run_directory), placement of raw memory (memory.h), arrays of
# members reached by index (vec.h), Array as a class (mirrored.h), explicit instantiation (recorder), loads by memcpy (pack.h).
cppcheck --enable=warning,portability --std=c++20 --language=c++ --quiet --error-exitcode=1 -j 2 -I src -U__CUDACC__ -UBRISANCE_CUDA --template='{file}:{line}: {severity} {id}: {message}' \
    --suppress=missingIncludeSystem --suppress=objectIndex:src/math/vec.h --suppress=CastIntegerToAddressAtReturn:src/particles/mirrored.h \
    --suppress=invalidPointerCast:src/exec/memory.h --suppress=pointerSize:src/exec/memory.h --suppress=uninitMemberVar:src/app/recorder.cpp \
    --suppress=uninitvar:src/math/pack.h --suppress=constStatement:src/geometry/relax.cpp --suppress=danglingTemporaryLifetime:src/io/run_directory.cpp src || failed=1
((${#files[@]})) && printf '%s\n' "${files[@]}" | xargs -P 2 -n 4 clang-tidy -p build/release --quiet --extra-arg=-Wno-unknown-warning-option 2>/dev/null | grep . && failed=1
exit $failed
