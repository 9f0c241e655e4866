// SPDX-License-Identifier: Apache-2.0
// Runs the unit tests: all, those of one file (--file=cloud_test.cpp, as ctest does), or what the flags of GoogleTest choose.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const std::string flag = "--file=";
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument.rfind(flag, 0) != 0) {
            std::fprintf(stderr, "unknown argument %s\n", argv[i]);
            return 2;
        }
        const std::string wanted = argument.substr(flag.size());
        std::string filter;
        const testing::UnitTest& all = *testing::UnitTest::GetInstance();
        for (int s = 0; s < all.total_test_suite_count(); ++s)
            for (int t = 0; t < all.GetTestSuite(s)->total_test_count(); ++t) {
                const testing::TestInfo& test = *all.GetTestSuite(s)->GetTestInfo(t);
                if (std::filesystem::path(test.file()).filename() == wanted) filter += std::string(test.test_suite_name()) + "." + test.name() + ":";
            }
        if (filter.empty()) {
            std::fprintf(stderr, "no tests come from a file %s\n", wanted.c_str());
            return 2;
        }
        testing::GTEST_FLAG(filter) = filter;
    }
    return RUN_ALL_TESTS();
}
