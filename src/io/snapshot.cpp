// SPDX-License-Identifier: Apache-2.0
#include "io/snapshot.h"

#include "base/error.h"
#include "io/hdf5.h"
#include "io/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>
#include <system_error>

namespace brisance {

namespace fs = std::filesystem;

namespace {

constexpr std::uint8_t vtk_poly_vertex = 2;
constexpr std::int64_t format_version[] = {1, 0};

std::string snapshot_name(std::size_t number) { return fmt::format("fields_{:04}.vtkhdf", number); }

std::size_t count(const SnapshotField& field) {
    return std::visit([](const auto& values) { return values.size(); }, field.values);
}

void check(const SnapshotField& field, std::size_t points, std::set<std::string>& names) {
    const auto refuse = [&](const std::string& why) {
        throw std::invalid_argument(fmt::format("snapshot field '{}': {}", field.name, why));
    };
    if (field.name.empty() || field.name == "." || field.name.find('/') != field.name.npos) refuse("not a name");
    if (!names.insert(field.name).second) refuse("given twice");
    if (field.components < 1) refuse("needs at least one component");
    if (const auto wanted = points * static_cast<std::size_t>(field.components); count(field) != wanted)
        refuse(fmt::format("{} values where {} points need {}", count(field), points, wanted));
}

/// Between xx, yy, zz, xy, xz, yz and VTK's xx, yy, zz, xy, yz, xz: its own inverse.
template <class T>
void exchange_tensor_order(std::vector<T>& values) {
    for (std::size_t i = 0; i + 5 < values.size(); i += 6) std::swap(values[i + 4], values[i + 5]);
}

hdf5::Shape shape_of(std::size_t points, int components) {
    if (components == 1) return {points};
    return {points, static_cast<std::uint64_t>(components)};
}

template <class T>
hdf5::Dataset write_values(hdf5::Group& group, const SnapshotField& field, const std::vector<T>& values, std::size_t points) {
    const hdf5::Shape shape = shape_of(points, field.components);
    if (field.components != 6) return group.write<T>(field.name, values, shape, hdf5::Storage::compressed);
    std::vector<T> exchanged = values;
    exchange_tensor_order(exchanged);
    return group.write<T>(field.name, exchanged, shape, hdf5::Storage::compressed);
}

template <class T>
void write_one(hdf5::Group& group, const char* name, T value) {
    group.write<T>(name, std::span<const T>(&value, 1), {1});
}

/// One cell that holds all points; none where there are none.
void write_cell(hdf5::Group& root, std::int64_t points) {
    const std::size_t cells = points > 0 ? 1 : 0;
    write_one<std::int64_t>(root, "NumberOfPoints", points);
    write_one<std::int64_t>(root, "NumberOfCells", static_cast<std::int64_t>(cells));
    write_one<std::int64_t>(root, "NumberOfConnectivityIds", points);
    std::vector<std::int64_t> ids(static_cast<std::size_t>(points));
    std::iota(ids.begin(), ids.end(), 0);
    root.write<std::int64_t>("Connectivity", ids, {ids.size()}, hdf5::Storage::compressed);
    const std::int64_t offsets[] = {0, points};
    root.write<std::int64_t>("Offsets", std::span(offsets, cells + 1), {cells + 1});
    root.write<std::uint8_t>("Types", std::span(&vtk_poly_vertex, cells), {cells});
}

template <class Real>
void write_part(const fs::path& part, double time_us, std::span<const Real> points, std::span<const SnapshotField> fields) {
    const std::size_t n = points.size() / 3;
    hdf5::File file = hdf5::File::create(part);
    {
        hdf5::Group root = file.create_group("VTKHDF");
        root.set_attribute<std::int64_t>("Version", std::span(format_version));
        root.set_attribute("Type", "UnstructuredGrid");
        write_cell(root, static_cast<std::int64_t>(n));
        root.write<Real>("Points", points, {n, 3}, hdf5::Storage::compressed).set_attribute("unit", "mm");
        root.create_group("FieldData").write<double>("time", std::span<const double>(&time_us, 1), {1}).set_attribute("unit", "us");
        hdf5::Group data = root.create_group("PointData");
        for (const SnapshotField& field : fields)
            std::visit([&](const auto& values) { write_values(data, field, values, n).set_attribute("unit", field.unit); }, field.values);
    }
    file.close();
}

template <class Real>
void write_atomically(const fs::path& path, double time_us, std::span<const Real> points, std::span<const SnapshotField> fields) {
    if (points.size() % 3 != 0) throw std::invalid_argument("snapshot: points need three coordinates each");
    std::set<std::string> names;
    for (const SnapshotField& field : fields) check(field, points.size() / 3, names);
    const fs::path part = part_path(path);
    try {
        write_part(part, time_us, points, fields);
    } catch (...) {
        std::error_code ignored;
        fs::remove(part, ignored);
        throw;
    }
    publish(path);
}

template <class T>
SnapshotField::Values read_values(const hdf5::Dataset& data, int components) {
    std::vector<T> values = data.read<T>();
    if (components == 6) exchange_tensor_order(values);
    return values;
}

SnapshotField read_field(const hdf5::Dataset& data, const std::string& name, std::size_t points) {
    const hdf5::Shape shape = data.shape();
    if (shape.empty() || shape.size() > 2 || shape[0] != points)
        throw ResourceError(
            fmt::format("{}: has the shape {}, not a row for each of {} points", data.where(), hdf5::to_string(shape), points));
    const int components = shape.size() == 1 ? 1 : static_cast<int>(shape[1]);
    SnapshotField field{name, data.has_attribute("unit") ? data.string_attribute("unit") : "", components, {}};
    switch (data.scalar()) {
        case hdf5::Scalar::float32: field.values = read_values<float>(data, components); break;
        case hdf5::Scalar::float64: field.values = read_values<double>(data, components); break;
        case hdf5::Scalar::int32: field.values = read_values<std::int32_t>(data, components); break;
        case hdf5::Scalar::uint8: field.values = read_values<std::uint8_t>(data, components); break;
        default: throw ResourceError(data.where() + ": holds numbers of a type that no snapshot has");
    }
    return field;
}

hdf5::Group snapshot_root(const hdf5::File& file, const fs::path& path) {
    const auto foreign = [&](const std::string& why) { throw ResourceError(fmt::format("{}: not a snapshot: {}", path.string(), why)); };
    if (!file.has("VTKHDF")) foreign("it has no group VTKHDF");
    hdf5::Group root = file.group("VTKHDF");
    if (!root.has_attribute("Type") || !root.has_attribute("Version")) foreign("/VTKHDF lacks the attribute Type or Version");
    if (const std::string type = root.string_attribute("Type"); type != "UnstructuredGrid") foreign("it holds a VTKHDF " + type);
    if (const auto version = root.attribute<std::int64_t>("Version"); version.size() != 2 || version[0] != format_version[0])
        foreign(fmt::format("it has VTKHDF version {}, known is 1", version.empty() ? 0 : version[0]));
    return root;
}

double read_one(const hdf5::Dataset& data) {
    const auto values = data.read<double>();
    if (values.size() != 1) throw ResourceError(fmt::format("{}: {} values where one is wanted", data.where(), values.size()));
    return values[0];
}

}  // namespace

const SnapshotField& Snapshot::field(const std::string& name) const {
    std::string names;
    for (const SnapshotField& field : fields) {
        if (field.name == name) return field;
        names += (names.empty() ? "" : ", ") + field.name;
    }
    throw ResourceError(fmt::format("the snapshot has no field '{}'; it has {}", name, names));
}

void write_snapshot(const fs::path& path, double time_us, std::span<const double> points, std::span<const SnapshotField> fields) {
    write_atomically(path, time_us, points, fields);
}

void write_snapshot(const fs::path& path, double time_us, std::span<const float> points, std::span<const SnapshotField> fields) {
    write_atomically(path, time_us, points, fields);
}

Snapshot read_snapshot(const fs::path& path) {
    const hdf5::File file = hdf5::File::open(path);
    const hdf5::Group root = snapshot_root(file, path);
    if (!root.has("FieldData") || !root.group("FieldData").has("time"))
        throw ResourceError(path.string() + ": not a snapshot of brisance: it has no /VTKHDF/FieldData/time");

    Snapshot snapshot;
    snapshot.time_us = read_one(root.group("FieldData").dataset("time"));
    const hdf5::Dataset points = root.dataset("Points");
    if (const hdf5::Shape shape = points.shape();
        shape.size() != 2 || shape[1] != 3 || static_cast<double>(shape[0]) != read_one(root.dataset("NumberOfPoints")))
        throw ResourceError(fmt::format("{}: has the shape {}, at odds with NumberOfPoints", points.where(), hdf5::to_string(shape)));
    snapshot.points = points.read<double>();
    const hdf5::Group data = root.group("PointData");
    for (const std::string& name : data.names()) snapshot.fields.push_back(read_field(data.dataset(name), name, snapshot.size()));
    return snapshot;
}

std::vector<fs::path> list_snapshots(const fs::path& folder) {
    std::vector<fs::path> paths;
    try {
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("fields_") && name.ends_with(".vtkhdf")) paths.push_back(entry.path());
        }
    } catch (const fs::filesystem_error& error) {
        throw ResourceError(fmt::format("{}: cannot list the snapshots: {}", folder.string(), error.code().message()));
    }
    const auto earlier = [](const fs::path& a, const fs::path& b) {  // 10000 comes after 9999
        return std::pair(a.native().size(), a.native()) < std::pair(b.native().size(), b.native());
    };
    std::sort(paths.begin(), paths.end(), earlier);
    return paths;
}

std::string SnapshotSeries::next_name() const { return snapshot_name(times_us_.size()); }

void SnapshotSeries::add(double time_us) {
    times_us_.push_back(time_us);
    std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
    for (std::size_t i = 0; i < times_us_.size(); ++i)
        text += fmt::format("{}\n    {{\"name\": \"{}\", \"time\": {}}}", i == 0 ? "" : ",", snapshot_name(i), times_us_[i]);
    write_file(folder_ / "fields.vtkhdf.series", text + "\n  ]\n}\n");
}

}  // namespace brisance
