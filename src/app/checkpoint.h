// SPDX-License-Identifier: Apache-2.0
// Checkpoints of a run: RUN/checkpoints/state_0.h5 and state_1.h5, the older one overwritten, each whole or not there.
#pragma once

#include "app/recorder.h"
#include "base/error.h"
#include "base/version.h"
#include "integrate/fields.h"
#include "io/archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace brisance {

inline constexpr const char* checkpoint_schema = "brisance checkpoint 1";

class Checkpoints {
public:
    explicit Checkpoints(const RunDirectory& run) : run_(run) {
        std::ifstream in(run.file("case.toml"), std::ios::binary);
        Checksum sum;
        sum.add(std::string(std::istreambuf_iterator<char>(in), {}));
        case_ = fmt::format("{:016x}", sum.value());
    }

    template <class R>
    void write(World<R>& w, Recorder<R>& recorder) {
        const std::uint64_t number = next_++;
        ArchiveWriter out(file(number));
        out.note("schema", checkpoint_schema);
        out.note("version", version());
        out.note("commit", commit());
        out.note("case", case_);
        out.note("number", std::to_string(number));
        out.note("time", fmt::format("{} us", w.time));
        each_field(w, out);
        recorder.each_field(out);
        out.close();
    }

    /// Gives a world that has begun, and its recorder, the newest state (`older`: the one before). Throws ResourceError that says what is
    /// wrong with a checkpoint and what there is beside it.
    template <class R>
    std::string read(World<R>& w, Recorder<R>& recorder, bool older) {
        std::vector<std::pair<std::uint64_t, std::filesystem::path>> found;
        std::string unreadable;
        for (std::uint64_t slot : {0, 1}) {
            const std::filesystem::path path = file(slot);
            if (!std::filesystem::exists(path)) continue;
            try {
                found.emplace_back(std::stoull(ArchiveReader(path).note("number")), path);
            } catch (const std::exception& e) {
                unreadable += std::string("\n  ") + e.what();
            }
        }
        std::sort(found.rbegin(), found.rend());
        const std::size_t chosen = older && unreadable.empty() ? 1 : 0;
        if (!unreadable.empty() && !older)
            throw ResourceError("a checkpoint cannot be read:" + unreadable + (found.empty() ? "" : "\n  --older takes the other one"));
        if (found.size() <= chosen) throw ResourceError(run_.checkpoints().string() + ": no " + (older ? "older " : "") + "checkpoint to go on from" + unreadable);
        const auto& [number, path] = found[chosen];
        try {
            ArchiveReader in(path);
            const auto same = [&](const char* what, const std::string& here) {
                if (in.note(what) != here)
                    throw ResourceError(fmt::format("{}: its {} is {}, here it is {}", path.string(), what, in.note(what), here));
            };
            same("schema", checkpoint_schema);
            same("version", version());
            same("case", case_);
            each_field(w, in);
            recorder.each_field(in);
            in.finish();
            next_ = number + 1;
            return fmt::format("{} at {}{}", path.filename().string(), in.note("time"),
                               in.note("commit") == commit() ? "" : ", written by another build (" + in.note("commit") + "): the bits may differ");
        } catch (const ResourceError& e) {
            throw ResourceError(std::string(e.what()) + (older || found.size() < 2 ? "" : "; --older takes the checkpoint before it"));
        }
    }

private:
    std::filesystem::path file(std::uint64_t number) const { return run_.checkpoints() / fmt::format("state_{}.h5", number % 2); }
    const RunDirectory& run_;
    std::string case_;
    std::uint64_t next_ = 0;
};

}  // namespace brisance
