# SPDX-License-Identifier: Apache-2.0
"""The check of the layers sees what it must see."""

import unittest

import check_layers

PAGE = "```arrows\nbase ->\nexec ->\nlaws -> base\nio -> base laws\napp -> *\n```\n```never\nlaws -> io\n```\n```threads\nio/log.cpp a reason\n```\n"
FILES = {"base/error.h": "", "exec/exec.h": "#pragma omp parallel for", "laws/law.cpp": '#include "base/error.h"\n#include <vector>',
         "io/log.cpp": "#ifdef _OPENMP", "app/main.cpp": '#include "io/log.h"\n#include "commit.h"', "io/log.h": ""}


class Layers(unittest.TestCase):
    def errors(self, page=PAGE, **changed):
        files = {name: check_layers.without_comments(text) for name, text in (FILES | {k: v for k, v in changed.items()}).items()}
        return list(check_layers.check(page, files))

    def expect(self, error, page=PAGE, **changed):
        self.assertEqual(self.errors(page, **changed), [error])

    def test_what_is_allowed(self):
        self.assertEqual(self.errors(), [])

    def test_arrow_that_is_not_allowed(self):
        self.expect("src/laws/law.cpp:2: laws must not include io", **{"laws/law.cpp": '\n#  include "io/log.h"'})
        self.expect("src/laws/law.cpp:1: laws must not include io", **{"laws/law.cpp": "#include <io/log.h>"})

    def test_comments_are_no_includes(self):
        self.assertEqual(self.errors(**{"laws/law.cpp": '/*\n#include "io/log.h"\n*/ // #pragma omp\nauto s = "//";'}), [])

    def test_header_that_does_not_exist(self):
        self.expect("src/laws/law.cpp:1: includes a header that is not in src/", **{"laws/law.cpp": '#include "io/none.h"'})

    def test_threads_outside_exec(self):
        self.expect("src/laws/law.cpp:2: #pragma omp outside exec (1 lines); use exec/exec.h", **{"laws/law.cpp": "\n#pragma omp simd"})
        self.expect("src/laws/law.cpp:1: __CUDACC__ outside exec (1 lines); use exec/exec.h", **{"laws/law.cpp": "#if defined(__CUDACC__)"})
        self.expect("src/io/log.cpp: needs no exception for threads any more", **{"io/log.cpp": ""})
        self.expect("exception for threads io/log.cpp: no reason is given", PAGE.replace(" a reason", ""))

    def test_circle(self):
        self.assertIn("the arrows go round in a circle through base", self.errors(PAGE.replace("base ->", "base -> laws", 1)))

    def test_never_through_others(self):
        errors = self.errors(PAGE.replace("base ->\n", "base -> exec\n").replace("laws -> io", "laws -> exec"))
        self.assertEqual(errors, ["the arrows let laws see exec, which it must never"])

    def test_folder_without_a_line(self):
        self.expect("src/new: has no line among the arrows", **{"new/new.h": ""})
        self.expect("src/old: has an arrow and no source", PAGE.replace("exec ->", "exec ->\nold ->"))

    def test_a_page_without_rules_is_an_error(self):
        for page in ("", PAGE.replace("```arrows", "```"), PAGE + PAGE, PAGE.replace("laws -> base", "laws: base")):
            with self.assertRaises(check_layers.BadPage):
                self.errors(page)


if __name__ == "__main__":
    unittest.main()
