// SPDX-License-Identifier: Apache-2.0
// Speed of the strength laws, updates per second of one core in double: ./build/release/laws_bench
// One benchmark per law, on the first material of the library that uses it, and the JH-2 granite.
#include "io/case_file.h"
#include "laws/batch.h"

#include <benchmark/benchmark.h>

#include <set>

namespace {

void update(benchmark::State& state, const std::string& name) {
    const brisance::Material material = brisance::make_material(brisance::read_material(name));
    const brisance::LawBatch batch(material, 512);
    for (auto _ : state) benchmark::DoNotOptimize(batch.update());
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(batch.points()));
    state.counters["yielding"] = batch.yielding();
    state.counters["failed"] = batch.failed();
}

}  // namespace

int main(int argc, char** argv) {
    std::set<std::string> laws;
    for (std::string name : brisance::list_materials()) {
        const brisance::MaterialData data = brisance::read_material(name);
        if (!data.strength || !laws.insert(data.strength->law).second) continue;
        if (data.strength->law == "jh2") name = "barre_granite";
        benchmark::RegisterBenchmark((data.strength->law + "/" + name).c_str(), update, name);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
