// SPDX-License-Identifier: Apache-2.0
#include "analysis/crack_directions.h"

#include "analysis/orientation.h"
#include "analysis/point_grid.h"
#include "analysis/statistics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>

namespace brisance::analysis {

namespace {

/// Sum of weight(i) over the damaged particles of each sector at r >= r_from.
template <class Weight>
std::vector<double> sum_by_sector(const SectionPoints& points, double threshold, int sectors, Weight weight, double r_from = 0) {
    if (sectors < 1) throw std::invalid_argument("directions: at least one sector");
    std::vector<double> sum(static_cast<std::size_t>(sectors), 0.0);
    for (std::size_t i = 0; i < points.count(); ++i)
        if (points.cracked(i, threshold) && points.radius(i) >= r_from)
            sum[static_cast<std::size_t>(sector_of(points.azimuth(i), sectors))] += weight(i);
    return sum;
}

void scale_to_mean(std::vector<double>& values, double total) {
    if (!(total > 0)) return;
    for (double& v : values) v *= static_cast<double>(values.size()) / total;
}

/// Size-weighted mean size of the groups of damaged particles at r >= r_from that hang together within a sector.
double mean_clump(const SectionPoints& points, double threshold, int sectors, double r_from) {
    const auto counts = [&](std::size_t i) { return points.cracked(i, threshold) && points.radius(i) >= r_from; };
    std::vector<std::size_t> root(points.count());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    const PointGrid grid(points.x, points.y, 2 * *std::min_element(points.size.begin(), points.size.end()));
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!counts(i)) continue;
        const int sector = sector_of(points.azimuth(i), sectors);
        grid.near(points.x[i], points.y[i], 1.5 * points.size[i], [&](std::size_t j) {
            if (counts(j) && sector_of(points.azimuth(j), sectors) == sector) root[find(i)] = find(j);
        });
    }
    std::vector<double> members(points.count(), 0.0);
    for (std::size_t i = 0; i < points.count(); ++i)
        if (counts(i)) members[find(i)] += 1;
    double n = 0, squares = 0;
    for (double m : members) {
        n += m;
        squares += m * m;
    }
    return squares / n;
}

}  // namespace

std::vector<double> direction_pdf(const SectionPoints& points, double threshold, int sectors) {
    auto pdf = sum_by_sector(points, threshold, sectors, [&](std::size_t i) { return points.damage[i]; });
    scale_to_mean(pdf, std::accumulate(pdf.begin(), pdf.end(), 0.0));  // (Eq. 13): bin / 360 = 1 / sectors
    return pdf;
}

std::vector<double> direction_pdf_normalised(const SectionPoints& points, double threshold, int sectors) {
    auto pdf = sum_by_sector(points, threshold, sectors, [&](std::size_t i) { return points.damage[i] * points.area(i); });
    double section = 0;
    for (std::size_t i = 0; i < points.count(); ++i) section += points.area(i);
    scale_to_mean(pdf, section);
    return pdf;
}

std::vector<double> direction_harmonics(const SectionPoints& points, double threshold, int highest) {
    std::vector<std::complex<double>> sum(static_cast<std::size_t>(std::max(0, highest)));
    double total = 0;
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.cracked(i, threshold)) continue;
        total += points.damage[i];
        for (std::size_t m = 1; m <= sum.size(); ++m) sum[m - 1] += std::polar(points.damage[i], static_cast<double>(m) * points.azimuth(i));
    }
    std::vector<double> harmonics;
    for (const auto& s : sum) harmonics.push_back(total > 0 ? std::abs(s) / total : 0);
    return harmonics;
}

IsotropyTest isotropy_test(const SectionPoints& points, double threshold, int sectors, double r_from) {
    const auto counts = sum_by_sector(points, threshold, sectors, [](std::size_t) { return 1.0; }, r_from);
    const double expected = std::accumulate(counts.begin(), counts.end(), 0.0) / sectors;
    IsotropyTest test;
    if (!(expected > 0)) return test;
    for (double n : counts) test.chi_square += (n - expected) * (n - expected) / expected;
    test.clump = mean_clump(points, threshold, sectors, r_from);
    if (sectors > 1) test.p_value = chi_square_survival(test.chi_square / test.clump, sectors - 1);
    return test;
}

double radial_coherence(const SectionPoints& points, double threshold) {
    const auto orientation = damage_orientation(points, threshold);
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.cracked(i, threshold)) continue;
        sum += points.damage[i] * orientation[i].strength * orientation[i].along;
        total += points.damage[i];
    }
    return total > 0 ? sum / total : 0;
}

}  // namespace brisance::analysis
