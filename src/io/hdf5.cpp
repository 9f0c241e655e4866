// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5.h"

#include "base/checksum.h"
#include "base/error.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <new>
#include <numeric>
#include <stdexcept>

namespace brisance::hdf5 {

namespace {

static_assert(std::same_as<hid_t, std::int64_t> && std::same_as<herr_t, int>);

constexpr std::uint64_t chunk_bytes = 1 << 20;

/// The innermost message on HDF5's error stack, the one that tells the cause; clears the stack.
std::string cause() {
    std::string text;
    const auto keep_first = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
        if (auto& first = *static_cast<std::string*>(out); first.empty() && error->desc != nullptr) first = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
    H5Eclear2(H5E_DEFAULT);
    constexpr std::string_view key = "error message = '";  // system errors are wrapped in a long list of offsets
    if (const auto start = text.find(key); start != text.npos) {
        const auto from = start + key.size();
        text = text.substr(from, text.find('\'', from) - from);
    }
    return text.empty() ? "no reason given by HDF5" : text;
}

[[noreturn]] void fail_at(const std::string& where, const std::string& what) {
    throw ResourceError(fmt::format("{}: {}: {}", where, what, cause()));
}

/// HDF5 prints its error stack unless told not to; our messages carry the cause. And at exit it closes what it takes for open:
/// after a full disk that is the lost file, and it crashes (1.10.8). Our objects close by scope and need no such help.
void begin() {
    static const bool begun = H5dont_atexit() >= 0 && H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
    static_cast<void>(begun);
}

hid_t native(Scalar type) {
    switch (type) {
        case Scalar::uint8: return H5T_NATIVE_UINT8;
        case Scalar::int32: return H5T_NATIVE_INT32;
        case Scalar::uint32: return H5T_NATIVE_UINT32;
        case Scalar::int64: return H5T_NATIVE_INT64;
        case Scalar::uint64: return H5T_NATIVE_UINT64;
        case Scalar::float32: return H5T_NATIVE_FLOAT;
        case Scalar::float64: return H5T_NATIVE_DOUBLE;
    }
    throw std::invalid_argument("unknown scalar type");
}

std::uint64_t product(const Shape& shape, std::size_t from = 0) {
    return std::accumulate(shape.begin() + static_cast<std::ptrdiff_t>(from), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

Handle space_of(const Shape& shape) {
    if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose};
}

/// Files are private until they are renamed and never change after, so locks would guard nothing, and some network file
/// systems refuse them. Closing a file with open objects is an error here, not a silent delay.
Handle file_access() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access.id(), H5F_CLOSE_SEMI);
    H5Pset_file_locking(access.id(), false, true);
    return access;
}

constexpr std::string_view seal_words = "brisance checksum ";
constexpr std::size_t seal_bytes = seal_words.size() + 16 + 1;

/// The last line of a file whose first `bytes` bytes are the data.
std::string seal_of(std::ifstream& in, std::uint64_t bytes) {
    Checksum sum;
    std::vector<char> buffer(1 << 20);
    in.seekg(0);
    while (bytes > 0) {
        const std::size_t n = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, buffer.size()));
        if (!in.read(buffer.data(), static_cast<std::streamsize>(n))) return {};
        sum.add(buffer.data(), n);
        bytes -= n;
    }
    return fmt::format("{}{:016x}\n", seal_words, sum.value());
}

void seal(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string line = seal_of(in, std::filesystem::file_size(path));
    errno = 0;
    std::ofstream out(path, std::ios::binary | std::ios::app);
    if (line.empty() || !(out << line).flush()) throw ResourceError(fmt::format("{}: cannot write its checksum: {}", path, std::strerror(errno ? errno : EIO)));
}

void check_seal(const std::filesystem::path& path) {
    constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
    const std::uint64_t size = std::filesystem::file_size(path);
    std::ifstream in(path, std::ios::binary);
    std::string head(signature.size(), '\0'), line(seal_bytes, '\0');
    if (!in.read(head.data(), static_cast<std::streamsize>(head.size())) || head != signature)
        throw ResourceError(path.string() + ": cannot open as HDF5: file signature not found");
    if (size >= signature.size() + seal_bytes) {
        in.seekg(static_cast<std::streamoff>(size - seal_bytes));
        in.read(line.data(), seal_bytes);
    }
    if (!line.starts_with(seal_words))
        throw ResourceError(path.string() + ": truncated, or changed by another program: its last line, the checksum, is missing");
    if (const std::string found = seal_of(in, size - seal_bytes); found != line)
        throw ResourceError(fmt::format("{}: damaged: its checksum is {}, the one written into it is {}", path.string(),
                                        found.empty() ? "unreadable" : found.substr(seal_words.size(), 16), line.substr(seal_words.size(), 16)));
}

}  // namespace

std::string to_string(const Shape& shape) {
    std::string text;
    for (const std::uint64_t extent : shape) text += fmt::format("{}{}", text.empty() ? "" : ", ", extent);
    return "[" + text + "]";
}

void Node::fail(const std::string& what) const { fail_at(where_, what); }

bool Node::has_attribute(const std::string& name) const { return H5Aexists(handle_.id(), name.c_str()) > 0; }

void Node::set_attribute(const std::string& name, std::string_view text) {
    const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), std::max<std::size_t>(text.size(), 1));
    H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
    H5Tset_cset(type.id(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(handle_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
    if (attribute.id() < 0 || H5Awrite(attribute.id(), type.id(), padded.data()) < 0) fail("cannot write attribute '" + name + "'");
}

void Node::write_attribute(const std::string& name, Scalar type, const void* values, const Shape& shape) {
    const Handle space = space_of(shape);
    const Handle attribute(H5Acreate2(handle_.id(), name.c_str(), native(type), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (attribute.id() < 0 || H5Awrite(attribute.id(), native(type), values) < 0) fail("cannot write attribute '" + name + "'");
}

std::string Node::string_attribute(const std::string& name) const {
    const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
    if (attribute.id() < 0) fail("cannot read attribute '" + name + "'");
    const Handle type(H5Aget_type(attribute.id()), H5Tclose);
    const Handle space(H5Aget_space(attribute.id()), H5Sclose);
    if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1)
        throw ResourceError(fmt::format("{}: attribute '{}' is not a string", where_, name));
    if (H5Tis_variable_str(type.id()) > 0) {  // as other programs write them
        char* text = nullptr;
        if (H5Aread(attribute.id(), type.id(), &text) < 0) fail("cannot read attribute '" + name + "'");
        std::string copy = text == nullptr ? "" : text;
        H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, &text);
        return copy;
    }
    std::string text(H5Tget_size(type.id()), '\0');
    if (H5Aread(attribute.id(), type.id(), text.data()) < 0) fail("cannot read attribute '" + name + "'");
    return text.substr(0, text.find('\0'));
}

std::size_t Node::attribute_size(const std::string& name) const {
    const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
    if (attribute.id() < 0) fail("cannot read attribute '" + name + "'");
    const Handle space(H5Aget_space(attribute.id()), H5Sclose);
    return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
}

void Node::read_attribute(const std::string& name, Scalar type, void* values) const {
    const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
    if (attribute.id() < 0 || H5Aread(attribute.id(), native(type), values) < 0) fail("cannot read attribute '" + name + "'");
}

Shape Dataset::shape() const {
    const Handle space(H5Dget_space(handle_.id()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    if (rank < 0) fail("cannot read the shape");
    std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
    return {extent.begin(), extent.end()};
}

Scalar Dataset::scalar() const {
    const Handle type(H5Dget_type(handle_.id()), H5Tclose);
    const std::size_t size = H5Tget_size(type.id());
    const H5T_class_t kind = H5Tget_class(type.id());
    if (kind == H5T_FLOAT && size == 4) return Scalar::float32;
    if (kind == H5T_FLOAT && size == 8) return Scalar::float64;
    const bool is_signed = kind == H5T_INTEGER && H5Tget_sign(type.id()) == H5T_SGN_2;
    if (kind == H5T_INTEGER && size == 1 && !is_signed) return Scalar::uint8;
    if (kind == H5T_INTEGER && size == 4) return is_signed ? Scalar::int32 : Scalar::uint32;
    if (kind == H5T_INTEGER && size == 8) return is_signed ? Scalar::int64 : Scalar::uint64;
    throw ResourceError(where_ + ": holds numbers of a type that brisance does not read");
}

std::size_t Dataset::checked_size(std::size_t bytes_each) const {
    std::uint64_t count = 1;
    for (const std::uint64_t extent : shape())
        if (__builtin_mul_overflow(count, extent, &count)) throw ResourceError(where_ + ": has an impossible shape; the file is damaged");
    constexpr std::uint64_t packing = 1100;  // deflate makes nothing smaller than this
    const std::uint64_t limit = packing * static_cast<std::uint64_t>(H5Dget_storage_size(handle_.id()));
    if (count > limit / bytes_each) throw ResourceError(fmt::format("{}: claims to hold {} numbers; the file is damaged", where_, count));
    return static_cast<std::size_t>(count);
}

void Dataset::read_raw(Scalar type, void* values) const {
    if (H5Dread(handle_.id(), native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail("cannot read");
}

std::string Group::place_of(const std::string& name) const {
    const bool at_root = where_.find(":/") == where_.npos;
    return where_ + (at_root ? ":/" : "/") + name;
}

Group Group::create_group(const std::string& name) {
    Handle group(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    if (group.id() < 0) fail("cannot create group '" + name + "'");
    return {std::move(group), place_of(name)};
}

Group Group::group(const std::string& name) const {
    Handle group(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose);
    if (group.id() < 0) fail("has no group '" + name + "'");
    return {std::move(group), place_of(name)};
}

Dataset Group::dataset(const std::string& name) const {
    Handle dataset(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (dataset.id() < 0) fail("has no dataset '" + name + "'");
    return {std::move(dataset), place_of(name)};
}

bool Group::has(const std::string& name) const { return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> Group::names() const {
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    if (H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) < 0) fail("cannot list the members");
    return names;
}

Dataset Group::write_raw(const std::string& name, Scalar type, const void* values, std::size_t count, const Shape& shape,
                         Storage storage) {
    if (product(shape) != count)
        throw std::invalid_argument(fmt::format("{}: {} numbers for a shape of {}", place_of(name), count, product(shape)));
    const Handle space = space_of(shape);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);  // equal data make equal bytes
    if (storage == Storage::compressed && !shape.empty() && count > 0) {
        const std::uint64_t row_bytes = product(shape, 1) * H5Tget_size(native(type));
        std::vector<hsize_t> chunk(shape.begin(), shape.end());
        chunk[0] = std::clamp<std::uint64_t>(chunk_bytes / row_bytes, 1, shape[0]);
        H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data());
        H5Pset_shuffle(creation.id());
        H5Pset_deflate(creation.id(), 1);
    }
    Handle dataset(H5Dcreate2(handle_.id(), name.c_str(), native(type), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Dclose);
    if (dataset.id() < 0) fail("cannot create dataset '" + name + "'");
    // The flush brings out what would else fail in silence when the dataset is closed.
    if (count > 0 && (H5Dwrite(dataset.id(), native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0 || H5Dflush(dataset.id()) < 0))
        fail("cannot write dataset '" + name + "'");
    return {std::move(dataset), place_of(name)};
}

File File::create(const std::filesystem::path& path) {
    begin();
    const Handle access = file_access();
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
    if (file.id() < 0) fail_at(path.string(), "cannot create");
    return {std::move(file), path.string()};
}

File File::open(const std::filesystem::path& path) {
    begin();
    if (!std::filesystem::is_regular_file(path)) throw ResourceError(path.string() + ": no such file");
    check_seal(path);
    const Handle access = file_access();
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
    if (file.id() < 0) fail_at(path.string(), "cannot open as HDF5");
    return {std::move(file), path.string()};
}

void File::close() {
    if (handle_.id() < 0) return;
    if (H5Fflush(handle_.id(), H5F_SCOPE_LOCAL) < 0 || H5Fclose(handle_.release()) < 0) fail("cannot write out");
    seal(where_);
}

}  // namespace brisance::hdf5
