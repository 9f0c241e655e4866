#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The reference of the case file: it knows every table and key that stands at the start of a line in the shipped cases.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

expect 0 reference
silent err
says out '^# The case file' '^\| key \| allowed \| default \| meaning \|'
cmp -s "$tmp/out" docs/reference/case-file.md || wrong "docs/reference/case-file.md is not what the program prints: ./brisance reference >docs/reference/case-file.md"
mapfile -t keys < <(sed -nE 's/^\[?\[([a-z_]+)[].].*/\1/p; /^[a-z_]+ = /{s/ .*//p}' cases/blast/*.toml | sort -u)
((${#keys[@]} > 5)) || wrong "no keys were found in the cases"
for key in "${keys[@]}"; do
    says out "\`$key\`"
done
finish
