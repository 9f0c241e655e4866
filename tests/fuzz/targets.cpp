// SPDX-License-Identifier: Apache-2.0
#include "fuzz/targets.h"

#include "base/error.h"
#include "base/units.h"
#include "io/archive.h"
#include "io/case_file.h"
#include "io/hdf5.h"
#include "io/snapshot.h"
#include "laws/material.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>

namespace brisance::fuzz {

namespace {

[[noreturn]] void wrong(const std::string& what) {
    std::fprintf(stderr, "fuzz: %s\n", what.c_str());
    std::abort();
}

/// The input as a file of its own name, since messages name the file.
class InputFile {
public:
    InputFile(const std::string& name, const std::uint8_t* data, std::size_t size) : path_(folder() + "/" + name) {
        const int fd = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (fd < 0 || ::write(fd, data, size) != static_cast<ssize_t>(size)) wrong("cannot write " + path_);
        ::close(fd);
    }
    ~InputFile() { ::unlink(path_.c_str()); }
    const std::string& path() const { return path_; }

private:
    /// In memory where there is such a file system; removed at exit.
    static const std::string& folder() {
        static std::string made = [] {
            std::string name = ::access("/dev/shm", W_OK) == 0 ? "/dev/shm/brisance_fuzz_XXXXXX" : "/tmp/brisance_fuzz_XXXXXX";
            if (!::mkdtemp(name.data())) wrong("cannot make a folder");
            return name;
        }();
        static const bool cleaned = std::atexit([] { ::rmdir(folder().c_str()); }) == 0;
        static_cast<void>(cleaned);
        return made;
    }
    std::string path_;
};

/// Reads the input as orders to write a file that HDF5 finds in order, with names, types and shapes of the input's choice. HDF5 itself
/// reads beyond its buffers where its own structures are damaged; from those the checksum keeps it (io/hdf5.h).
class Scribe {
public:
    Scribe(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

    void fill(hdf5::Group& group, std::span<const char* const> names, int depth = 0) {
        for (int orders = 0; orders < 12 && at_ < end_; ++orders) {
            const std::string name = names[next() % names.size()];
            try {
                const unsigned order = next() % 12;
                if (order == 0) group.set_attribute(name, std::string_view(reinterpret_cast<const char*>(at_), static_cast<std::size_t>(end_ - at_) % 9));
                else if (order == 1) group.set_attribute<std::int64_t>(name, number());
                else if (order == 2 && depth < 2) {
                    hdf5::Group inner = group.create_group(name);
                    fill(inner, names, depth + 1);
                } else if (order == 3) return;
                else if (order % 4 == 0) dataset<float>(group, name);
                else if (order % 4 == 1) dataset<double>(group, name);
                else if (order % 4 == 2) dataset<std::uint8_t>(group, name);
                else if (order == 7) dataset<std::int32_t>(group, name);
                else dataset<std::int64_t>(group, name);
            } catch (const ResourceError&) {  // a name that is taken
            }
        }
    }

private:
    unsigned next() { return at_ < end_ ? *at_++ : 0u; }
    std::int64_t number() { return static_cast<std::int64_t>(next()) - 2; }
    template <class T>
    void dataset(hdf5::Group& group, const std::string& name) {
        hdf5::Shape shape;
        std::size_t count = 1;
        for (unsigned rank = next() % 4; rank > 0; --rank) {
            shape.push_back(next() % 8);
            count *= shape.back();
        }
        std::vector<T> values(count);
        for (T& v : values) v = static_cast<T>(next());
        group.write<T>(name, values, shape, next() % 2 ? hdf5::Storage::compressed : hdf5::Storage::contiguous).set_attribute("unit", "mm");
    }
    const std::uint8_t *at_, *end_;
};

/// Runs `read`, which may refuse, but not without words.
template <class F>
void refuse_or(F&& read) {
    try {
        read();
    } catch (const Error& e) {
        if (std::string_view(e.what()).size() < 10) wrong(std::string("a refusal that says nothing: ") + e.what());
    }
}

}  // namespace

int units(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        const Quantity q = read_quantity(text);
        if (!std::isfinite(q.value)) wrong("a quantity that is no number: " + text);
        if (parse_quantity(text, q.dimension) != q.value) wrong("read twice, two values: " + text);
        parse_quantity(text, dimension::length);
    } catch (const std::invalid_argument& e) {
        if (std::string_view(e.what()).size() < 10) wrong(std::string("a refusal that says nothing: ") + e.what());
    }
    return 0;
}

int material(const std::uint8_t* data, std::size_t size) {
    const InputFile file("fuzzed.toml", data, size);
    refuse_or([&] {
        const Material m = make_material(read_material(file.path()));
        if (!(m.density > 0) || !(m.sound_speed() > 0) || !std::isfinite(m.sound_speed())) wrong("a material without density or sound");
    });
    return 0;
}

int case_file(const std::uint8_t* data, std::size_t size) {
    const InputFile file("case.toml", data, size);
    refuse_or([&] {
        const Case c = read_case(file.path(), "", {});
        const InputFile again("again.toml", reinterpret_cast<const std::uint8_t*>(c.resolved.data()), c.resolved.size());
        try {
            const Case same = read_case(again.path(), "", {});
            if (same.until != c.until || same.parts.size() != c.parts.size()) wrong("the resolved case says something else");
        } catch (const InputError& e) {
            wrong(std::string("the resolved case is refused: ") + e.what());
        }
        for (const PartData& p : c.parts) make_material(p.material);
    });
    return 0;
}

int checkpoint(const std::uint8_t* data, std::size_t size) {
    const auto read = [](const std::string& path) {
        refuse_or([&] {
            ArchiveReader in(path);
            double number = 0;
            std::int64_t count = 0;
            std::string text;
            std::vector<float> values;
            in("number", number);
            in("count", count);
            in("text", text);
            in("values", values);
            in.finish();
        });
    };
    const InputFile file("state.h5", data, size);
    read(file.path());
    auto out = hdf5::File::create(file.path());
    constexpr const char* names[] = {"number", "count", "text", "values", "checksum"};
    Scribe(data, size).fill(out, names);
    out.close();
    read(file.path());
    return 0;
}

int snapshot(const std::uint8_t* data, std::size_t size) {
    const auto read = [](const std::string& path) {
        refuse_or([&] {
            const Snapshot s = read_snapshot(path);
            for (const SnapshotField& f : s.fields) {
                const std::size_t count = std::visit([](const auto& values) { return values.size(); }, f.values);
                if (f.components < 0 || count != s.size() * static_cast<std::size_t>(f.components)) wrong("field " + f.name + " does not fit its points");
            }
        });
    };
    const InputFile file("fields_0000.vtkhdf", data, size);
    read(file.path());
    auto out = hdf5::File::create(file.path());
    {
        constexpr const char* names[] = {"PointData", "FieldData", "time", "Points", "NumberOfPoints", "damage", "stress"};
        Scribe scribe(data, size);
        hdf5::Group root = out.create_group("VTKHDF");
        const std::int64_t version[] = {1, 0};
        if (size % 8 != 1) root.set_attribute("Type", "UnstructuredGrid");
        if (size % 8 != 2) root.set_attribute<std::int64_t>("Version", std::span(version));
        if (size % 8 != 3) {  // most often all is there but for what the orders add
            const double time = 1, points[] = {0, 1, 2, 3, 4, 5};
            const std::int64_t count = 2;
            root.create_group("FieldData").write<double>("time", std::span(&time, 1), {1});
            root.write<double>("Points", std::span(points), {2, 3});
            root.write<std::int64_t>("NumberOfPoints", std::span(&count, 1), {1});
            hdf5::Group fields = root.create_group("PointData");
            scribe.fill(fields, names, 2);
        }
        scribe.fill(root, names);
    }
    out.close();
    read(file.path());
    return 0;
}

}  // namespace brisance::fuzz
