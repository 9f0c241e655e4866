#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the #include arrows between the folders of src/ against the blocks `arrows`, `never` and `threads` of docs/architecture.md.

    check_layers.py            errors, exit status 1 if there are any
    check_layers.py --today    the arrows that the sources have now
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SUFFIXES = {".h", ".cpp", ".cu", ".cuh"}
THREADS = re.compile(r"#\s*pragma\s+omp\b|_Pragma\s*\(\s*\"omp\b|<omp\.h>|\bomp_\w+\s*\(|\b_OPENMP\b"
                     r"|\b__CUDA(?:CC|_ARCH)__\b|\b__(?:global|device|shared)__\b|\bcuda[A-Z]\w*\s*\(|<cuda\w*\.h>")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|(\"(?:\\.|[^\"\\\n])*\")", re.S)


class BadPage(Exception):
    """The page does not say what it must; the rules would be empty or contradict each other."""


def block(page, name):
    """The lines of the one fenced block with this name."""
    found = re.findall(rf"^```{name}\n(.*?)^```$", page, re.S | re.M)
    if len(found) != 1:
        raise BadPage(f"there must be one block ```{name}, there are {len(found)}")
    lines = [line.strip() for line in found[0].splitlines() if line.strip()]
    if not lines:
        raise BadPage(f"the block ```{name} is empty")
    return lines


def arrows(lines):
    """{folder: set of folders} from lines "folder -> folder folder"."""
    result = {}
    for line in lines:
        match = re.fullmatch(r"(\w+)\s*->((?:\s+[\w*]+)*)", line)
        if not match or match[1] in result:
            raise BadPage(f"not an arrow, or a second line for the same folder: {line}")
        result[match[1]] = set(match[2].split())
    for folder, targets in result.items():
        if "*" in targets:
            result[folder] = set(result) - {folder}
    return result


def reach(graph, start):
    """Every folder that can be seen from this one, through others too."""
    seen, todo = set(), [start]
    while todo:
        for target in graph.get(todo.pop(), ()):
            if target not in seen:
                seen.add(target)
                todo.append(target)
    return seen


def without_comments(text):
    return COMMENT.sub(lambda m: m[1] or "\n" * m[0].count("\n"), text)


def read(source):
    """{path below src/: text without comments}."""
    files = {p.relative_to(source).as_posix(): p for p in sorted(source.rglob("*")) if p.suffix in SUFFIXES}
    return {name: without_comments(p.read_text(encoding="utf-8")) for name, p in files.items()}


def includes(name, text, files):
    """(line, folder) of every include of ours; the folder of a header that does not exist is None."""
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r'\s*#\s*include\s+["<]([^">]+)[">]', line)
        if not match or (match[1] not in files and "<" in line):
            continue
        generated = "/" not in match[1]  # commit.h, written by the build
        if not generated:
            yield number, match[1].split("/")[0] if match[1] in files else None


def check(page, files):
    """Yields the errors, each a line of text."""
    allowed = arrows(block(page, "arrows"))
    never = arrows(block(page, "never"))
    threads = dict((line.split(maxsplit=1) + [""])[:2] for line in block(page, "threads"))

    folders = {name.split("/")[0] for name in files}
    for folder in sorted(folders ^ set(allowed)):
        yield f"src/{folder}: {'has no line among the arrows' if folder in folders else 'has an arrow and no source'}"
    for folder, targets in allowed.items():
        for unknown in sorted(targets - set(allowed)):
            yield f"arrow {folder} -> {unknown}: no such folder"
        if folder in reach(allowed, folder):
            yield f"the arrows go round in a circle through {folder}"
    for folder, targets in never.items():
        for unknown in sorted(({folder} | targets) - set(allowed)):
            yield f"never {folder} -> {unknown}: no such folder"
        for target in sorted(targets & reach(allowed, folder)):
            yield f"the arrows let {folder} see {target}, which it must never"

    for name, text in files.items():
        folder = name.split("/")[0]
        for line, target in includes(name, text, files):
            if target is None:
                yield f"src/{name}:{line}: includes a header that is not in src/"
            elif target != folder and target not in allowed.get(folder, ()):
                yield f"src/{name}:{line}: {folder} must not include {target}"
        found = [(i, m[0]) for i, line in enumerate(text.splitlines(), 1) if (m := THREADS.search(line))]
        if found and folder != "exec" and name not in threads:
            yield f"src/{name}:{found[0][0]}: {found[0][1]} outside exec ({len(found)} lines); use exec/exec.h"
        if name in threads and not found:
            yield f"src/{name}: needs no exception for threads any more"
    for name, reason in threads.items():
        if name not in files or not reason:
            yield f"exception for threads {name}: {'no reason is given' if name in files else 'no such file'}"


def today(files):
    result = {}
    for name, text in files.items():
        folder = name.split("/")[0]
        result.setdefault(folder, set()).update(t for _, t in includes(name, text, files) if t not in (None, folder))
    return result


def main(arguments):
    files = read(ROOT / "src")
    if "--today" in arguments:
        for folder, targets in sorted(today(files).items(), key=lambda a: (len(a[1]), a)):
            print(f"{folder:<12} -> {' '.join(sorted(targets))}".rstrip())
        return 0
    try:
        errors = list(check((ROOT / "docs" / "architecture.md").read_text(encoding="utf-8"), files))
    except BadPage as error:
        errors = [str(error)]
    for error in errors:
        print(error if error.startswith("src/") else f"docs/architecture.md: {error}")
    print(f"{len(files)} files of src/, {len(errors)} errors")
    return bool(errors)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
