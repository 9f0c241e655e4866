// SPDX-License-Identifier: Apache-2.0
// What a run leaves behind: audit, gauges, histories, snapshots, fracture analysis.
#pragma once

#include "analysis/section_report.h"
#include "integrate/watchdog.h"
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
    /// `go_on`: append to the files of an earlier run; each_field must then give the recorder its state.
    Recorder(const Case& c, const World<R>& w, const RunDirectory& run, bool go_on = false);

    /// The next time at which something is due; steps end there. us.
    double next_due() const;
    /// Writes what is due at the present time; returns the audit where a row was written.
    std::optional<Audit> record(const World<R>& w);
    /// Final analysis and section files.
    void finish(const World<R>& w);

    const Leaks& leaks() const { return leaks_; }

    /// What a checkpoint holds of the record: what is due next, series, the sections as they were, and how long each file was.
    template <class V>
    void each_field(V&& visit) {
        visit("record.next_history", next_history_);
        visit("record.next_snapshot", next_snapshot_);
        visit("record.leaked", leaks_.count);
        visit("record.borehole.time", borehole_.time);
        visit("record.borehole.value", borehole_.value);
        visit("record.front.time", front_.time);
        visit("record.front.value", front_.value);
        visit("record.snapshots", snapshots_.times());
        visit("record.sections.time", taken_.time);
        visit("record.sections.damage", taken_.damage);
        visit("record.sections.cause", taken_.cause);
        visit("record.files", file_lengths());
    }
    /// After each_field has read: files back to their lengths, sections analysed again.
    void go_on(const World<R>& w);

private:
    struct Gauge {
        std::string name;
        std::size_t solid = 0;
        std::int64_t slot = 0;
        std::size_t tile = 0;   ///< that holds the slot
        CsvFile file;
    };
    struct Section {
        SectionData data;
        std::vector<std::int64_t> slots;
        std::vector<std::size_t> columns;
    };
    analysis::SectionPoints sample(const World<R>& w, const Section& s) const;
    analysis::FractureReport fracture_report(const World<R>& w) const;
    void analyse(const World<R>& w);
    std::vector<CsvFile*> files();
    std::vector<std::int64_t>& file_lengths();
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
    /// The sections at each analysis, one after the other: enough to make the reports again.
    struct {
        std::vector<double> time, damage;
        std::vector<std::uint8_t> cause;
    } taken_;
    std::vector<std::int64_t> lengths_;
    analysis::SectionOptions options_;
    analysis::TimeSeries borehole_, front_;
    SnapshotSeries snapshots_;
    double next_history_ = 0;
    std::uint64_t next_snapshot_ = 0;
    Leaks leaks_;
};

}  // namespace brisance
