// SPDX-License-Identifier: Apache-2.0
#include "app/checkpoint.h"

#include "base/error.h"
#include "base/version.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <optional>

namespace brisance {

namespace {

constexpr const char* schema = "brisance checkpoint 5";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

std::string on_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// "1.25" of our own making.
double number_of(const ArchiveReader& in, const std::string& name) {
    const std::string text = in.note(name);
    try {
        return std::stod(text);
    } catch (const std::exception&) {
        throw ResourceError(fmt::format("its note '{}' is no number: '{}'", name, text));
    }
}

}  // namespace

Checkpoints::Checkpoints(const RunDirectory& run) : run_(run) {
    std::ifstream in(run.file("case.toml"), std::ios::binary);
    Checksum sum;
    sum.add(std::string(std::istreambuf_iterator<char>(in), {}));
    case_ = fmt::format("{:016x}", sum.value());
}

std::filesystem::path Checkpoints::file(std::uint64_t number) const { return run_.checkpoints() / fmt::format("state_{}.h5", number % 2); }

void Checkpoints::head(ArchiveWriter& out, std::uint64_t number, double time, double until, const Provenance& p) const {
    std::string settings, resumed;
    for (const std::string& s : p.settings) settings += on_one_line(s) + '\n';
    for (const Provenance::Resumed& r : p.resumed) resumed += fmt::format("{}\n{}\n{}\n", r.at, r.from_us, on_one_line(r.command));
    out.note("schema", schema);
    out.note("version", version());
    out.note("commit", commit());
    out.note("case", case_);
    out.note("number", std::to_string(number));
    out.note("time_us", fmt::format("{}", time));
    out.note("until_us", fmt::format("{}", until));
    out.note("command", p.command);
    out.note("started", p.started);
    out.note("case_file", p.case_file);
    out.note("preset", p.preset);
    out.note("settings", settings);
    out.note("resumed", resumed);
}

Checkpoints::Found Checkpoints::find(bool older) const {
    std::optional<Found> best, second;
    std::string unreadable;
    for (std::uint64_t slot : {0, 1}) {
        const std::filesystem::path path = file(slot);
        if (!std::filesystem::exists(path)) continue;
        try {
            const ArchiveReader in(path);
            if (in.note("schema") != schema) throw ResourceError(fmt::format("{}: is not a checkpoint of this program: its schema is '{}', here it is '{}'", path.string(), in.note("schema"), schema));
            if (in.note("version") != version()) throw ResourceError(fmt::format("{}: was written by brisance {}, this is {}", path.string(), in.note("version"), version()));
            if (in.note("case") != case_)
                throw ResourceError(fmt::format("{}: belongs to another case: {} is not what it was when the run began (checksum {}, now {})", path.string(),
                                                run_.file("case.toml").string(), in.note("case"), case_));
            Found f;
            f.path = path;
            f.number = static_cast<std::uint64_t>(number_of(in, "number"));
            f.time = number_of(in, "time_us");
            f.until = number_of(in, "until_us");
            f.provenance.command = in.note("command");
            f.provenance.started = in.note("started");
            f.provenance.case_file = in.note("case_file");
            f.provenance.preset = in.note("preset");
            f.provenance.settings = lines_of(in.note("settings"));
            const std::vector<std::string> resumed = lines_of(in.note("resumed"));
            for (std::size_t k = 0; k + 2 < resumed.size(); k += 3) f.provenance.resumed.push_back({resumed[k], resumed[k + 2], std::stod(resumed[k + 1])});
            if (in.note("commit") != commit()) f.remark = ", written by another build (" + in.note("commit") + "): the bits may differ";
            if (!best || f.number > best->number) std::swap(best, second), best = std::move(f);
            else second = std::move(f);
        } catch (const std::exception& e) {
            unreadable += std::string("\n  ") + e.what();
        }
    }
    if (!older && unreadable.empty() && best) return *best;
    if (older && !unreadable.empty() && best) return *best;  // the other one is what the user wants to avoid
    if (older && second) return *second;
    if (!unreadable.empty())
        throw ResourceError("a checkpoint cannot be used:" + unreadable +
                            (best ? fmt::format("\n  --older takes the other one, {} at t = {:g} us", best->path.filename().string(), best->time) : ""));
    if (best) throw ResourceError(fmt::format("{}: there is one checkpoint only, {}, and none older", run_.checkpoints().string(), best->path.filename().string()));
    throw ResourceError(run_.checkpoints().string() + ": no checkpoint to go on from: the run ended before its first one (output.checkpoint); start it again with "
                                                      "brisance run and --overwrite");
}

}  // namespace brisance
