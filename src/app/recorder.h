// SPDX-License-Identifier: Apache-2.0
// What a run leaves behind: audit, gauges, histories, snapshots, fracture analysis.
#pragma once

#include "analysis/section_report.h"
#include "integrate/world.h"
#include "io/case.h"
#include "io/csv.h"
#include "io/run_directory.h"
#include "io/snapshot.h"

#include <memory>
#include <optional>

namespace brisance {

template <class R>
class Recorder {
public:
    Recorder(const Case& c, const World<R>& w, const RunDirectory& run);

    /// The next time at which something is due; steps end there. us.
    double next_due() const;
    /// Writes what is due at the present time; returns the audit where a row was written.
    std::optional<Audit> record(const World<R>& w);
    /// Final analysis and section files.
    void finish(const World<R>& w);

    std::int64_t leaked() const { return leaked_; }

private:
    struct Gauge {
        std::string name;
        std::size_t solid = 0;
        std::int64_t slot = 0;
        std::size_t column = 0;
        CsvFile file;
    };
    struct Section {
        SectionData data;
        std::vector<std::int64_t> slots;
        std::vector<std::size_t> columns;
    };
    analysis::SectionPoints sample(const World<R>& w, const Section& s) const;
    analysis::FractureReport fracture_report(const World<R>& w) const;
    void write_gauges(const World<R>& w);
    void write_snapshot(const World<R>& w);
    void write_audit(const Audit& a);

    const Case& case_;
    const RunDirectory& run_;
    std::size_t analysed_ = 0;
    bool has_analysed_ = false;
    CsvFile audit_, history_;
    std::vector<Gauge> gauges_;
    std::vector<Section> sections_;
    std::vector<analysis::SectionHistory> reports_;
    analysis::SectionOptions options_;
    analysis::TimeSeries borehole_, front_;
    SnapshotSeries snapshots_;
    double next_history_ = 0;
    std::size_t next_snapshot_ = 0;
    std::int64_t leaked_ = 0;
};

/// Fluid particles that stand inside a solid: the solids' mass fraction around them, sum V W, exceeds 0.6 (it is a half on a wall).
template <class R> std::int64_t count_leaks(const World<R>& w);

}  // namespace brisance
