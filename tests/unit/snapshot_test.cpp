// SPDX-License-Identifier: Apache-2.0
#include "io/snapshot.h"

#include "base/error.h"
#include "io/hdf5.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

namespace fs = std::filesystem;
using namespace brisance;

namespace {

class Snapshots : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "brisance_snapshot_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

const std::vector<double> three_points = {0.1, 0.2, 0.3, 1, 2, 3, -4.5, 5.25, 6};

std::vector<SnapshotField> some_fields() {
    return {
        {"damage", "-", 1, std::vector<float>{0, 0.5f, 1}},
        {"failure_time", "us", 1, std::vector<double>{0.1, 1e-300, 3}},
        {"part", "-", 1, std::vector<std::int32_t>{-1, 70000, 2}},
        {"state", "-", 1, std::vector<std::uint8_t>{0, 128, 255}},
        {"stress", "GPa", 6, std::vector<float>{1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 15, 16, 21, 22, 23, 24, 25, 26}},
        {"velocity", "km/s", 3, std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}},
    };
}

std::string message_of(auto&& action) {
    try {
        action();
    } catch (const ResourceError& error) {
        return error.what();
    }
    return "no ResourceError";
}

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::string listed(const auto& items) {
    std::string text;
    for (const auto& item : items) text += fmt::format("{}{}", text.empty() ? "" : ", ", item);
    return "[" + text + "]";
}

/// What VTK should see: the tensor in VTK's order.
std::string expectation(double time, const std::vector<double>& points, std::vector<SnapshotField> fields) {
    std::vector<std::string> arrays;
    for (auto& field : fields) {
        std::visit(
            [&](auto& values) {
                for (std::size_t i = 0; field.components == 6 && i < values.size(); i += 6) std::swap(values[i + 4], values[i + 5]);
                const std::vector<double> numbers(values.begin(), values.end());
                arrays.push_back(fmt::format(R"({{"name": "{}", "components": {}, "values": {}}})", field.name, field.components,
                                             listed(numbers)));
            },
            field.values);
    }
    return fmt::format(R"({{"points": {}, "cells": {}, "time": {}, "coordinates": {}, "arrays": {}}})", points.size() / 3,
                       points.empty() ? 0 : 1, time, listed(points), listed(arrays));
}

/// The exit code of VTK's reader in tests/cli, its words in `output`.
int read_with_vtk(const fs::path& snapshot, const std::string& expected, std::string& output) {
    std::ofstream(snapshot.string() + ".json") << expected;
    const std::string command = fmt::format("/usr/bin/python3 {}/tests/cli/read_snapshot_with_vtk.py {} {}.json > {}.out 2>&1",
                                            BRISANCE_SOURCE_DIR, snapshot.string(), snapshot.string(), snapshot.string());
    const int status = std::system(command.c_str());
    output = text_of(snapshot.string() + ".out");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_F(Snapshots, come_back_as_they_were_written) {
    const auto fields = some_fields();
    write_snapshot(folder / "a.vtkhdf", 12.5, std::span<const double>(three_points), fields);
    const Snapshot read = read_snapshot(folder / "a.vtkhdf");
    EXPECT_EQ(read.time_us, 12.5);
    EXPECT_EQ(read.points, three_points);
    ASSERT_EQ(read.fields.size(), fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {  // some_fields() is in alphabetical order
        EXPECT_EQ(read.fields[i].name, fields[i].name);
        EXPECT_EQ(read.fields[i].unit, fields[i].unit);
        EXPECT_EQ(read.fields[i].components, fields[i].components);
        EXPECT_EQ(read.fields[i].values, fields[i].values) << fields[i].name;
    }
    EXPECT_EQ(read.field("velocity").components, 3);
    EXPECT_NE(message_of([&] { read.field("velocty"); }).find("it has damage, failure_time"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "a.vtkhdf.part"));
}

TEST_F(Snapshots, of_many_chunks_come_back) {
    constexpr std::size_t n = 200'000;
    std::mt19937 random(1);
    std::vector<float> points(3 * n), damage(n);
    for (auto& x : points) x = static_cast<float>(random()) * 1e-8f;
    for (auto& d : damage) d = random() % 4 == 0 ? 1.0f : 0.0f;
    const std::vector<SnapshotField> fields = {{"damage", "-", 1, damage}};
    write_snapshot(folder / "many.vtkhdf", 1, std::span<const float>(points), fields);
    const Snapshot read = read_snapshot(folder / "many.vtkhdf");
    EXPECT_EQ(read.points, std::vector<double>(points.begin(), points.end()));
    EXPECT_EQ(read.fields.at(0).values, fields[0].values);
    EXPECT_LT(fs::file_size(folder / "many.vtkhdf"), points.size() * 4 + n);  // without compression: 24 bytes a point
}

TEST_F(Snapshots, are_read_by_vtk) {
    std::string output;
    const fs::path path = folder / "fields_0000.vtkhdf";
    write_snapshot(path, 12.5, std::span<const double>(three_points), some_fields());
    const int code = read_with_vtk(path, expectation(12.5, three_points, some_fields()), output);
    if (code == 77) GTEST_SKIP() << output;
    EXPECT_EQ(code, 0) << output;

    const fs::path empty = folder / "empty.vtkhdf";
    const std::vector<SnapshotField> no_values = {{"damage", "-", 1, std::vector<float>{}}};
    write_snapshot(empty, 0, std::span<const double>(), no_values);
    EXPECT_EQ(read_snapshot(empty).fields.size(), 1u);
    EXPECT_EQ(read_with_vtk(empty, expectation(0, {}, {}), output), 0) << output;  // without points VTK leaves out the arrays

    EXPECT_EQ(read_with_vtk(path, expectation(12.5, three_points, {some_fields()[0]}), output), 1) << "the script must see a difference";
}

TEST_F(Snapshots, hold_the_attributes_of_the_format) {
    write_snapshot(folder / "a.vtkhdf", 1, std::span<const double>(three_points), some_fields());
    const auto file = hdf5::File::open(folder / "a.vtkhdf");
    const auto root = file.group("VTKHDF");
    EXPECT_EQ(root.attribute<std::int64_t>("Version"), (std::vector<std::int64_t>{1, 0}));
    EXPECT_EQ(root.string_attribute("Type"), "UnstructuredGrid");
    EXPECT_EQ(root.dataset("Offsets").read<std::int64_t>(), (std::vector<std::int64_t>{0, 3}));
    EXPECT_EQ(root.dataset("Connectivity").read<std::int64_t>(), (std::vector<std::int64_t>{0, 1, 2}));
    EXPECT_EQ(root.dataset("Points").string_attribute("unit"), "mm");
    EXPECT_EQ(root.group("PointData").dataset("stress").string_attribute("unit"), "GPa");
}

TEST_F(Snapshots, refuse_fields_that_do_not_fit) {
    const std::span<const double> points(three_points);
    const auto write = [&](std::vector<SnapshotField> fields) { write_snapshot(folder / "a.vtkhdf", 0, points, fields); };
    const SnapshotField good{"p", "GPa", 1, std::vector<float>{1, 2, 3}};
    EXPECT_THROW(write({{"p", "GPa", 1, std::vector<float>{1, 2}}}), std::invalid_argument);
    EXPECT_THROW(write({{"p", "GPa", 3, std::vector<float>{1, 2, 3}}}), std::invalid_argument);
    EXPECT_THROW(write({{"a/b", "GPa", 1, std::vector<float>{1, 2, 3}}}), std::invalid_argument);
    EXPECT_THROW(write({good, good}), std::invalid_argument);
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Snapshots, that_are_none_are_refused_with_a_reason) {
    EXPECT_NE(message_of([&] { read_snapshot(folder / "absent.vtkhdf"); }).find("absent.vtkhdf: no such file"), std::string::npos);

    std::ofstream(folder / "text.vtkhdf") << "this is no HDF5 file\n";
    EXPECT_NE(message_of([&] { read_snapshot(folder / "text.vtkhdf"); }).find("cannot open as HDF5: file signature not found"),
              std::string::npos);

    auto foreign = hdf5::File::create(folder / "foreign.h5");
    foreign.create_group("PartType0");
    foreign.close();
    EXPECT_NE(message_of([&] { read_snapshot(folder / "foreign.h5"); }).find("no group VTKHDF"), std::string::npos);

    const fs::path whole = folder / "whole.vtkhdf";
    write_snapshot(whole, 1, std::span<const double>(three_points), some_fields());
    for (const std::uintmax_t size : {fs::file_size(whole) - 1, fs::file_size(whole) / 2, std::uintmax_t{600}, std::uintmax_t{0}}) {
        fs::copy_file(whole, folder / "torn.vtkhdf", fs::copy_options::overwrite_existing);
        fs::resize_file(folder / "torn.vtkhdf", size);
        const std::string message = message_of([&] { read_snapshot(folder / "torn.vtkhdf"); });
        const char* reason = size == 0 ? "torn.vtkhdf: cannot open as HDF5" : "torn.vtkhdf: truncated";
        EXPECT_NE(message.find(reason), std::string::npos) << size << ": " << message;
    }
}

TEST_F(Snapshots, with_one_bit_changed_are_refused) {
    const fs::path path = folder / "whole.vtkhdf";
    write_snapshot(path, 1, std::span<const double>(three_points), some_fields());
    const auto size = static_cast<std::streamoff>(fs::file_size(path));
    for (const std::streamoff at : {std::streamoff{9}, size / 3, size - 60, size - 2}) {
        fs::copy_file(path, folder / "bad.vtkhdf", fs::copy_options::overwrite_existing);
        std::fstream file(folder / "bad.vtkhdf", std::ios::in | std::ios::out | std::ios::binary);
        file.seekg(at);
        const auto byte = static_cast<char>(file.get() ^ 4);
        file.seekp(at);
        file.put(byte);
        file.close();
        EXPECT_NE(message_of([&] { read_snapshot(folder / "bad.vtkhdf"); }).find("bad.vtkhdf: damaged: its checksum is"), std::string::npos) << at;
    }
}

TEST_F(Snapshots, at_odds_with_themselves_are_refused) {
    auto file = hdf5::File::create(folder / "odd.vtkhdf");
    {
        auto root = file.create_group("VTKHDF");
        const std::int64_t version[] = {1, 0}, four[] = {4};
        const double time[] = {1};
        root.set_attribute<std::int64_t>("Version", std::span(version));
        root.set_attribute("Type", "UnstructuredGrid");
        root.create_group("FieldData").write<double>("time", time, {1});
        root.write<std::int64_t>("NumberOfPoints", four, {1});
        root.write<double>("Points", three_points, {3, 3});
    }
    file.close();
    EXPECT_NE(message_of([&] { read_snapshot(folder / "odd.vtkhdf"); }).find("at odds with NumberOfPoints"), std::string::npos);
}

TEST_F(Snapshots, on_a_full_disk_leave_nothing_behind) {
    const fs::path path = folder / "big.vtkhdf";
    const pid_t child = ::fork();
    if (child == 0) {  // a limit on the size of files stands for the full disk
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        std::vector<double> points(30'000);
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = 1 / (1.0 + static_cast<double>(i));
        const std::string message = message_of([&] { write_snapshot(path, 1, std::span<const double>(points), {}); });
        const bool good = message.find("big.vtkhdf") != message.npos && message.find("File too large") != message.npos;
        std::exit(good ? 0 : 1);  // runs HDF5's own end, which must not complain about the lost file
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Snapshots, into_a_folder_that_is_not_there_say_so) {
    const auto write = [&] { write_snapshot(folder / "none" / "a.vtkhdf", 1, std::span<const double>(three_points), {}); };
    EXPECT_NE(message_of(write).find("No such file or directory"), std::string::npos) << message_of(write);
}

TEST_F(Snapshots, in_a_series_are_numbered_and_listed_with_their_times) {
    SnapshotSeries series(folder);
    EXPECT_EQ(series.write(0, std::span<const double>(three_points), some_fields()).filename(), "fields_0000.vtkhdf");
    EXPECT_EQ(series.write(2.5, std::span<const double>(three_points), some_fields()).filename(), "fields_0001.vtkhdf");
    EXPECT_EQ(text_of(folder / "fields.vtkhdf.series"),
              "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
              "    {\"name\": \"fields_0000.vtkhdf\", \"time\": 0},\n"
              "    {\"name\": \"fields_0001.vtkhdf\", \"time\": 2.5}\n  ]\n}\n");
    std::ofstream(folder / "fields_10000.vtkhdf");
    std::ofstream(folder / "fields_9999.vtkhdf");
    std::ofstream(folder / "fields_0002.vtkhdf.part");
    std::vector<std::string> names;
    for (const auto& path : list_snapshots(folder)) names.push_back(path.filename().string());
    EXPECT_EQ(names, (std::vector<std::string>{"fields_0000.vtkhdf", "fields_0001.vtkhdf", "fields_9999.vtkhdf", "fields_10000.vtkhdf"}));
    EXPECT_THROW(list_snapshots(folder / "none"), ResourceError);
}

TEST_F(Snapshots, hdf5_layer_keeps_every_number_type_and_text) {
    auto file = hdf5::File::create(folder / "all.h5");
    const std::vector<std::uint64_t> large = {0, ~std::uint64_t{0}};
    const std::vector<std::uint32_t> middle = {7, ~std::uint32_t{0}};
    {
        auto large_set = file.write<std::uint64_t>("large", large, {2, 1}, hdf5::Storage::compressed);
        large_set.set_attribute("empty", "");
        large_set.set_attribute("greek", "\xC2\xB5s");
        large_set.set_attribute("seed", std::uint64_t{42});
        file.write<std::uint32_t>("middle", middle, {2});
        EXPECT_THROW(file.write<std::uint32_t>("wrong", middle, {3}), std::invalid_argument);
        EXPECT_NE(message_of([&] { file.write<std::uint32_t>("middle", middle, {2}); }).find("name already exists"), std::string::npos);
    }
    file.close();
    const auto read = hdf5::File::open(folder / "all.h5");
    EXPECT_EQ(read.names(), (std::vector<std::string>{"large", "middle"}));
    const auto large_set = read.dataset("large");
    EXPECT_EQ(large_set.shape(), (hdf5::Shape{2, 1}));
    EXPECT_EQ(large_set.scalar(), hdf5::Scalar::uint64);
    EXPECT_EQ(large_set.read<std::uint64_t>(), large);
    EXPECT_EQ(large_set.string_attribute("empty"), "");
    EXPECT_EQ(large_set.string_attribute("greek"), "\xC2\xB5s");
    EXPECT_EQ(large_set.attribute<std::uint64_t>("seed"), std::vector<std::uint64_t>{42});
    EXPECT_EQ(read.dataset("middle").read<std::uint32_t>(), middle);
    const std::string message = message_of([&] { read.dataset("none"); });
    EXPECT_NE(message.find("all.h5: has no dataset 'none'"), std::string::npos) << message;
}
