// SPDX-License-Identifier: Apache-2.0
// A thin owner's layer over HDF5: files, groups, datasets of numbers and attributes, closed by scope. Every failure becomes
// a ResourceError that names the file, the object in it and HDF5's own innermost reason. Not for use by several threads at once.
//
// Behind the HDF5 data of each file stands one line, "brisance checksum <16 digits>", over all bytes before it; HDF5 and its readers pass
// over it. It is checked before HDF5 looks at a file, since the library trusts what it reads and dies of damaged files.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brisance::hdf5 {

enum class Scalar { uint8, int32, uint32, int64, uint64, float32, float64 };

/// The numbers that a dataset or an attribute can hold.
template <class T>
concept Number = std::same_as<T, std::uint8_t> || std::same_as<T, std::int32_t> || std::same_as<T, std::uint32_t> ||
                 std::same_as<T, std::int64_t> || std::same_as<T, std::uint64_t> || std::same_as<T, float> || std::same_as<T, double>;

template <Number T>
constexpr Scalar scalar_of() {
    if constexpr (std::same_as<T, std::uint8_t>) return Scalar::uint8;
    if constexpr (std::same_as<T, std::int32_t>) return Scalar::int32;
    if constexpr (std::same_as<T, std::uint32_t>) return Scalar::uint32;
    if constexpr (std::same_as<T, std::int64_t>) return Scalar::int64;
    if constexpr (std::same_as<T, std::uint64_t>) return Scalar::uint64;
    if constexpr (std::same_as<T, float>) return Scalar::float32;
    if constexpr (std::same_as<T, double>) return Scalar::float64;
}

using Shape = std::vector<std::uint64_t>;
/// "[5, 3]"
std::string to_string(const Shape& shape);

/// `compressed`: chunks of whole rows, bytes shuffled, deflated at level 1.
enum class Storage { contiguous, compressed };

/// An open HDF5 object; closes it at the end of its scope.
class Handle {
public:
    using Closer = int (*)(std::int64_t);
    Handle() = default;
    Handle(std::int64_t id, Closer closer) : id_(id), closer_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(closer_, other.closer_);
        return *this;
    }
    ~Handle() {
        if (id_ >= 0) closer_(id_);
    }
    std::int64_t id() const { return id_; }
    std::int64_t release() { return std::exchange(id_, -1); }

private:
    std::int64_t id_ = -1;
    Closer closer_ = nullptr;
};

/// What groups and datasets share: a place for messages ("run/fields_0000.vtkhdf:/VTKHDF/Points"), and attributes.
class Node {
public:
    const std::string& where() const { return where_; }

    bool has_attribute(const std::string& name) const;

    /// A fixed-length string, ASCII where it can be, else UTF-8.
    void set_attribute(const std::string& name, std::string_view text);
    template <Number T>
    void set_attribute(const std::string& name, T value) {
        write_attribute(name, scalar_of<T>(), &value, {});
    }
    template <Number T>
    void set_attribute(const std::string& name, std::span<const T> values) {
        write_attribute(name, scalar_of<T>(), values.data(), {values.size()});
    }

    std::string string_attribute(const std::string& name) const;

    /// All values of an attribute, a single one for a scalar, converted to T.
    template <Number T>
    std::vector<T> attribute(const std::string& name) const {
        std::vector<T> values(attribute_size(name));
        read_attribute(name, scalar_of<T>(), values.data());
        return values;
    }

protected:
    Node(Handle handle, std::string where) : handle_(std::move(handle)), where_(std::move(where)) {}
    [[noreturn]] void fail(const std::string& what) const;

    Handle handle_;
    std::string where_;

private:
    void write_attribute(const std::string& name, Scalar type, const void* values, const Shape& shape);
    std::size_t attribute_size(const std::string& name) const;
    void read_attribute(const std::string& name, Scalar type, void* values) const;
};

class Dataset : public Node {
public:
    /// Rows first: {N}, {N, 3}; empty for a single value.
    Shape shape() const;
    /// The number type in the file. Throws ResourceError for one that is not a Scalar.
    Scalar scalar() const;

    /// All values, row after row, converted to T.
    template <Number T>
    std::vector<T> read() const {
        std::vector<T> values;
        values.resize(checked_size(sizeof(T)));
        read_raw(scalar_of<T>(), values.data());
        return values;
    }

private:
    friend class Group;
    using Node::Node;
    std::size_t checked_size(std::size_t bytes_each) const;
    void read_raw(Scalar type, void* values) const;
};

class Group : public Node {
public:
    Group create_group(const std::string& name);
    Group group(const std::string& name) const;
    Dataset dataset(const std::string& name) const;
    bool has(const std::string& name) const;
    /// The names of the members, in alphabetical order.
    std::vector<std::string> names() const;

    /// Writes a new dataset; `values` holds product(shape) numbers, row after row (else std::invalid_argument).
    template <Number T>
    Dataset write(const std::string& name, std::span<const T> values, const Shape& shape, Storage storage = Storage::contiguous) {
        return write_raw(name, scalar_of<T>(), values.data(), values.size(), shape, storage);
    }

protected:
    using Node::Node;

private:
    std::string place_of(const std::string& name) const;
    Dataset write_raw(const std::string& name, Scalar type, const void* values, std::size_t count, const Shape& shape, Storage storage);
};

class File : public Group {
public:
    /// Creates or truncates.
    static File create(const std::filesystem::path& path);
    /// Opens for reading. The message tells a missing file from one that is not HDF5, from a truncated and from a damaged one.
    static File open(const std::filesystem::path& path);
    /// Writes out what is buffered, closes, and adds the checksum; only after it is the data known to be in the file, and the file
    /// readable. Close groups and datasets before.
    void close();

private:
    using Group::Group;
};

}  // namespace brisance::hdf5
