// SPDX-License-Identifier: Apache-2.0
// Snapshots of all particles as VTKHDF 1.0 `UnstructuredGrid` files with one poly-vertex cell: ParaView 5.11, VTK 9.1 and any
// HDF5 reader open them.
//
// In the file: /VTKHDF/Points [N, 3] in mm, /VTKHDF/PointData/<name> [N] or [N, components] with the attribute "unit",
// /VTKHDF/FieldData/time [1] with the unit "us". Symmetric tensors lie there in VTK's order xx, yy, zz, xy, yz, xz and
// here in that of Sym3: xx, yy, zz, xy, xz, yz; writing and reading exchange the last two.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace brisance {

struct SnapshotField {
    using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>>;
    std::string name, unit;   ///< unit "-" where there is none
    int components = 1;       ///< 1; 3: vector; 6: symmetric tensor; 9: tensor, row-major
    Values values;            ///< N x components, particle after particle
};

struct Snapshot {
    double time_us = 0;
    std::vector<double> points;          ///< N x 3, mm
    std::vector<SnapshotField> fields;   ///< in alphabetical order

    std::size_t size() const { return points.size() / 3; }
    /// Throws ResourceError that lists the fields there are.
    const SnapshotField& field(const std::string& name) const;
};

/// Writes path whole or not at all, by way of path + ".part". `points` is N x 3 in mm. Throws ResourceError with path and cause (disk
/// full, permission), std::invalid_argument where a field has no name, another's name, a slash in it, or a wrong number of values.
void write_snapshot(const std::filesystem::path& path, double time_us, std::span<const double> points,
                    std::span<const SnapshotField> fields);
void write_snapshot(const std::filesystem::path& path, double time_us, std::span<const float> points,
                    std::span<const SnapshotField> fields);

/// Reads what write_snapshot wrote. Throws ResourceError with path and cause for a file that is absent, truncated, not a snapshot, or at
/// odds with itself.
Snapshot read_snapshot(const std::filesystem::path& path);

/// The snapshots of a run in their order in time: fields_0000.vtkhdf, fields_0001.vtkhdf, ... of its folder snapshots/.
std::vector<std::filesystem::path> list_snapshots(const std::filesystem::path& folder);

/// Numbers snapshots, and after each rewrites fields.vtkhdf.series, with which ParaView opens all of them with their times.
class SnapshotSeries {
public:
    explicit SnapshotSeries(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Returns the file written. Throws as write_snapshot does.
    template <class Real>
    std::filesystem::path write(double time_us, std::span<const Real> points, std::span<const SnapshotField> fields) {
        std::filesystem::path path = folder_ / next_name();
        write_snapshot(path, time_us, points, fields);
        add(time_us);
        return path;
    }

    std::size_t size() const { return times_us_.size(); }
    /// The times of the snapshots so far, us; given back, the series goes on from there.
    std::vector<double>& times() { return times_us_; }

private:
    std::string next_name() const;
    void add(double time_us);

    std::filesystem::path folder_;
    std::vector<double> times_us_;
};

}  // namespace brisance
