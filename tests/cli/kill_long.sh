#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fifty SIGKILLs at random moments, half of them while a checkpoint or a snapshot is being written: after each the run goes on from
# what it left, and the end is that of the undisturbed run, byte for byte. KILLS and SEED choose others.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/small_case.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/kills.sh"
kill_and_resume "${KILLS:-50}" "${SEED:-1}"
finish
