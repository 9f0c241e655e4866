// SPDX-License-Identifier: Apache-2.0
// Named quantities into a file and back, each with its size and all under one checksum. A visitor that calls archive(name, x) writes and
// reads with the same code (integrate/fields.h). The file appears whole or not at all.
#pragma once

#include "base/checksum.h"
#include "io/hdf5.h"

#include <filesystem>
#include <type_traits>

namespace brisance {

/// Visits fields and takes their hash; writes nothing.
class StateHash {
public:
    template <class T> void operator()(const std::string& name, T& x) {
        sum_.add(name);
        if constexpr (std::is_arithmetic_v<T>) sum_.add(&x, sizeof x);
        else sum_.add(x.data(), x.size() * sizeof(*x.data()));
    }
    std::uint64_t value() const { return sum_.value(); }

private:
    Checksum sum_;
};

class ArchiveWriter {
public:
    /// Goes to part_path(path) until `close`.
    explicit ArchiveWriter(std::filesystem::path path);
    ~ArchiveWriter();
    void note(const std::string& name, const std::string& text);

    template <class T> void operator()(const std::string& name, T& x) {
        hash_(name, x);
        if constexpr (std::is_arithmetic_v<T>) put(name, std::span<const T>(&x, 1));
        else if constexpr (std::is_same_v<T, std::string>) put(name, std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(x.data()), x.size()));
        else put(name, std::span<const std::remove_cvref_t<decltype(*x.data())>>(x.data(), x.size()));
    }
    /// Checksum, fsync, and the name. Throws ResourceError; the file before it then still stands.
    void close();

private:
    template <class T> void put(const std::string& name, std::span<const T> values) { file_.write<T>(name, values, {values.size()}); }
    std::filesystem::path path_;
    hdf5::File file_;
    StateHash hash_;
    bool closed_ = false;
};

class ArchiveReader {
public:
    explicit ArchiveReader(const std::filesystem::path& path) : file_(hdf5::File::open(path)) {}
    std::string note(const std::string& name) const { return file_.string_attribute(name); }

    /// Vectors that have a size already keep it: another one in the file is an error. Empty ones take what there is.
    template <class T> void operator()(const std::string& name, T& x) {
        if constexpr (std::is_arithmetic_v<T>) x = get<T>(name, 1)[0];
        else if constexpr (std::is_same_v<T, std::string>) {
            const auto bytes = get<std::uint8_t>(name, 0);
            x.assign(bytes.begin(), bytes.end());
        } else {
            const auto values = get<std::remove_cvref_t<decltype(*x.data())>>(name, x.size());
            x.assign(values.begin(), values.end());
        }
        hash_(name, x);
    }
    /// Throws ResourceError where what was read is not what was written.
    void finish() const;

private:
    template <class T> std::vector<T> get(const std::string& name, std::size_t wanted) const {
        const hdf5::Dataset data = file_.dataset(name);
        if (data.scalar() != hdf5::scalar_of<T>()) fail(data.where() + ": holds numbers of another type");
        std::vector<T> values = data.read<T>();
        if (wanted != 0 && values.size() != wanted) fail(data.where() + ": holds another number of values than this case has");
        return values;
    }
    [[noreturn]] static void fail(const std::string& what);
    hdf5::File file_;
    StateHash hash_;
};

}  // namespace brisance
