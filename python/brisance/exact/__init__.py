# SPDX-License-Identifier: Apache-2.0
"""Answers that brisance is held against, from programs that share no code with it: closed forms and small solvers of their own."""
