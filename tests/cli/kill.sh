#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The short form of kill_long.sh: six SIGKILLs.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/small_case.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/kills.sh"
kill_and_resume "${KILLS:-6}" "${SEED:-1}"
finish
