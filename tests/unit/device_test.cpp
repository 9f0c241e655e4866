// SPDX-License-Identifier: Apache-2.0
// The loops of exec/launch.h against plain ones, and, in the build split, that the pretend device lets nobody trespass.
#include "exec/launch.h"
#include "law_helpers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace brisance;

namespace {

Array<double> numbers(std::size_t n) {
    law_test::Random random(7);
    Array<double> a(n);
    for (double& x : a) x = random.uniform(-1, 1);
    return a;
}

}  // namespace

TEST(Launch, ReachesEveryItemOnce) {
    Array<std::int32_t> seen(10007, 0);
    std::int32_t* const s = seen.data();
    exec::launch(10007, BRISANCE_KERNEL(std::int64_t i) { ++s[i]; });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 10007);
    exec::launch(0, BRISANCE_KERNEL(std::int64_t i) { ++s[i]; });
    EXPECT_EQ(std::accumulate(seen.begin(), seen.end(), 0), 10007);
}

TEST(Launch, SumsAndFindsTheLargest) {
    for (const std::size_t n : {std::size_t{1}, std::size_t{255}, std::size_t{256}, std::size_t{70001}}) {
        const Array<double> a = numbers(n);
        const double* const p = a.data();
        const auto items = static_cast<std::int64_t>(n);
        double sum = 0;
        for (double x : a) sum += x;
        EXPECT_NEAR(exec::launch_sum(items, BRISANCE_KERNEL(std::int64_t i) { return p[i]; }), sum, 1e-13 * static_cast<double>(n));
        EXPECT_EQ(exec::launch_max(items, -5.0, BRISANCE_KERNEL(std::int64_t i) { return p[i]; }), *std::max_element(a.begin(), a.end()));
        EXPECT_EQ(exec::launch_max(items, 5.0, BRISANCE_KERNEL(std::int64_t i) { return p[i]; }), 5.0);
    }
    EXPECT_EQ(exec::launch_sum(0, BRISANCE_KERNEL(std::int64_t) { return 1.0; }), 0.0);
}

TEST(Launch, SumsHaveTheSameBitsOnAnyNumberOfThreads) {
    const Array<double> a = numbers(70001);
    const double* const p = a.data();
    const int threads = exec::threads();
    const auto sum = [&] { return exec::launch_sum(70001, BRISANCE_KERNEL(std::int64_t i) { return p[i]; }); };
    const double with_all = sum();
    for (const int n : {1, 3}) {
        exec::set_threads(n);
        EXPECT_EQ(sum(), with_all);
    }
    exec::set_threads(threads);
}

// Few items and many, which the threads share.
TEST(Launch, SelectsInOrder) {
    const int threads = exec::threads();
    for (const int n : {5000, 70001})
        for (const int t : {1, 3}) {
            exec::set_threads(t);
            const Array<double> a = numbers(n);
            const double* const p = a.data();
            Array<std::int32_t> found(static_cast<std::size_t>(n));
            std::int32_t* const f = found.data();
            const std::int64_t count =
                exec::select(n, BRISANCE_KERNEL(std::int64_t i) { return p[i] > 0.3; }, BRISANCE_KERNEL(std::int64_t i, std::int64_t k) { f[k] = static_cast<std::int32_t>(i); });
            std::vector<std::int32_t> expected;
            for (std::size_t i = 0; i < a.size(); ++i)
                if (a[i] > 0.3) expected.push_back(static_cast<std::int32_t>(i));
            found.resize(static_cast<std::size_t>(count));
            EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end())) << n << " items, " << t << " threads";
        }
    exec::set_threads(threads);
}

TEST(Launch, SortsIntoBucketsAndKeepsTheOrderWithin) {
    const int threads = exec::threads();
    for (const std::int64_t n : {3000, 50000})
        for (const std::int64_t buckets : {1, 40, 200000})
            for (const int t : {1, 3}) {
                exec::set_threads(t);
                Array<std::int32_t> bucket(static_cast<std::size_t>(n)), order(static_cast<std::size_t>(n));
                Array<std::int64_t> begin(static_cast<std::size_t>(buckets + 1));
                law_test::Random random(3);
                // some are empty, the first and the last among them
                for (std::int32_t& b : bucket) b = static_cast<std::int32_t>(static_cast<double>(buckets) * random.uniform(0.1, 0.9));
                exec::bucket_sort(bucket.data(), n, buckets, order.data(), begin.data());
                exec::wait();
                std::vector<std::int32_t> expected(static_cast<std::size_t>(n));
                std::iota(expected.begin(), expected.end(), 0);
                std::stable_sort(expected.begin(), expected.end(), [&](std::int32_t a, std::int32_t b) { return bucket[static_cast<std::size_t>(a)] < bucket[static_cast<std::size_t>(b)]; });
                EXPECT_TRUE(std::equal(order.begin(), order.end(), expected.begin())) << n << " items, " << buckets << " buckets, " << t << " threads";
                std::vector<std::int64_t> starts(static_cast<std::size_t>(buckets + 1));
                for (const std::int32_t b : bucket) ++starts[static_cast<std::size_t>(b) + 1];
                std::partial_sum(starts.begin(), starts.end(), starts.begin());
                EXPECT_TRUE(std::equal(begin.begin(), begin.end(), starts.begin(), starts.end())) << n << " items, " << buckets << " buckets, " << t << " threads";
            }
    exec::set_threads(threads);
}

TEST(Launch, ScansInPlace) {
    const int threads = exec::threads();
    for (const std::int64_t n : {1, 5000, 70001})
        for (const int t : {1, 3}) {
            exec::set_threads(t);
            Array<std::int64_t> number(static_cast<std::size_t>(n));
            law_test::Random random(5);
            for (std::int64_t& a : number) a = static_cast<std::int64_t>(random.uniform(0, 9));
            std::vector<std::int64_t> expected(number.size());
            std::exclusive_scan(number.begin(), number.end(), expected.begin(), std::int64_t{0});
            const std::int64_t all = expected.back() + number.back();
            EXPECT_EQ(exec::scan(number.data(), n), all);
            exec::wait();
            EXPECT_TRUE(std::equal(number.begin(), number.end(), expected.begin())) << n << " items, " << t << " threads";
        }
    exec::set_threads(threads);
    EXPECT_EQ(exec::scan(nullptr, 0), 0);
}

#ifdef BRISANCE_SPLIT
TEST(PretendDeviceDeathTest, StopsTheProcessorWithinAStep) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    Array<double> a(100, 1.0);
    EXPECT_EQ(a[3], 1.0);  // outside of a step it may look
    EXPECT_DEATH({
        const exec::DevicePhase phase;
        volatile double x = a[3];
        (void)x;
    }, "touched memory of the device");
    const exec::DevicePhase phase;
    const exec::HostAccess host;
    EXPECT_EQ(a[3], 1.0);  // and where it says so
}

TEST(PretendDeviceDeathTest, StopsAKernelThatHoldsAPointerOfTheProcessor) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    std::vector<double> mine(100000, 1.0);
    Array<double> ours(100000, 1.0);
    double *const m = mine.data(), *const o = ours.data();
    const exec::DevicePhase phase;
    exec::launch(100, BRISANCE_KERNEL(std::int64_t i) { o[i] = 2; });
    EXPECT_DEATH(exec::launch(100, BRISANCE_KERNEL(std::int64_t i) { m[i] = 2; }), "not memory of the device");
    EXPECT_DEATH(exec::launch(100, [&](std::int64_t i) { o[i] = 2; }), "not memory of the device");  // captures by reference: of the stack
}
#endif
