// SPDX-License-Identifier: Apache-2.0
// Checkpoints of a run: RUN/checkpoints/state_0.h5 and state_1.h5, the older one overwritten, each whole or not there.
#pragma once

#include "app/recorder.h"
#include "integrate/fields.h"
#include "io/archive.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace brisance {

class Checkpoints {
public:
    explicit Checkpoints(const RunDirectory& run);

    /// A checkpoint that this program can go on from, and what it says of its run.
    struct Found {
        std::filesystem::path path;
        std::uint64_t number = 0;
        double time = 0, until = 0;  ///< us
        Provenance provenance;       ///< of the run so far: command, start, case file, preset, settings, earlier resumes
        std::string remark;          ///< ", written by another build ...", or nothing
    };
    /// The newest (`older`: the one before). Throws ResourceError that says what is wrong with a checkpoint, truncated, damaged, of another
    /// version or another case, and what there is beside it.
    Found find(bool older) const;

    /// Writes the state over the older of the two. The one before stays whole whatever happens.
    template <class R>
    void write(World<R>& w, Recorder<R>& recorder, const Provenance& p, double until) {
        ArchiveWriter out(file(next_));
        head(out, next_, w.time, until, p);
        each_field(w, out);
        recorder.each_field(out);
        out.close();
        ++next_;
    }

    /// Gives a world that has begun, and its recorder, the state. Throws ResourceError where it does not fit.
    template <class R>
    void read(const Found& found, World<R>& w, Recorder<R>& recorder) {
        ArchiveReader in(found.path);
        each_field(w, in);
        recorder.each_field(in);
        in.finish();
        next_ = found.number + 1;
    }

private:
    std::filesystem::path file(std::uint64_t number) const;
    void head(ArchiveWriter& out, std::uint64_t number, double time, double until, const Provenance& p) const;
    const RunDirectory& run_;
    std::string case_;   ///< checksum of case.toml
    std::uint64_t next_ = 0;
};

}  // namespace brisance
