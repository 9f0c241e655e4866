// SPDX-License-Identifier: Apache-2.0
#include "contact/chosen_points.h"
#include "contact/gathered.h"
#include "contact/stiffness.h"
#include "exec/launch.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

struct Touched {
    double stored = 0, overlap = 0;
    std::int64_t touching = 0;
    BRISANCE_HD Touched& operator+=(const Touched& o) {
        stored += o.stored;
        overlap = std::max(overlap, o.overlap);
        touching += o.touching;
        return *this;
    }
};

/// Particles of one size, within a factor of two (the last: and all that are larger). Gas that has expanded into the open is many times as wide as
/// the rest: in one grid with it, everybody would look through cells of its size.
struct Layer {
    RingMapView map;
    const std::int32_t* points = nullptr;
    double widest = 0;
};
constexpr int layers = 4;

/// One of the two fluids.
struct Side {
    FluidView body;
    const double *spacing, *modulus;
    double *f[3], *press, *near;
    MirroredView points;
    NodeGroupsView groups;
    Layer layer[layers];
};

/// Kept between steps for its memory; contact is not re-entrant.
struct Sorted {
    Mirrored points;
    ChosenPoints chosen[layers];
};

Side side(const FluidBody& b, FluidForces& f, Sorted& sorted, double largest, std::int64_t looks) {
    sorted.points.build(b, largest);
    Side s{view(b), f.spacing.data(), f.modulus.data(), {f.fx.data(), f.fy.data(), f.fz.data()}, f.press.data(), f.near.data(), sorted.points.view(), f.group(b), {}};
    const MirroredView points = s.points;
    const double* const spacing = s.spacing;
    const std::int64_t n = sorted.points.size();
    double above = 0, below = 1.3 * b.spacing;
    for (int k = 0; k < layers && above < f.largest_spacing; ++k) {
        if (k == layers - 1) below = 1e300;
        std::int32_t* const list = sorted.chosen[k].list(n);
        const std::int64_t count = exec::select(n, BRISANCE_KERNEL(std::int64_t i) {
            const double kappa = spacing[points.particle(i)];
            return kappa > above && kappa <= below;
        }, BRISANCE_KERNEL(std::int64_t i, std::int64_t m) { list[m] = static_cast<std::int32_t>(i); });
        if (count > 0) {
            const double widest = exec::launch_max(count, 0.0, BRISANCE_KERNEL(std::int64_t m) { return spacing[points.particle(list[m])]; });
            sorted.chosen[k].build(points.place[0], points.place[1], points.place[2], count, widest, largest, b.z_low, b.period, looks);
            s.layer[k] = {sorted.chosen[k].view(), list, widest};
        }
        above = below;
        below *= 2;
    }
    return s;
}

/// What a group of particles of one side feels of the other.
struct NodeKernel {
    Side me, other;
    ContactOptions o;
    Touched* touched;
    BRISANCE_HD void operator()(std::int64_t g) const {
        PointBox box;
        double widest = 0;
        me.groups.each(g, [&](std::int64_t i) {
            box += box_of(me.body.x[0][i], me.body.x[1][i], me.body.x[2][i]);
            widest = std::max(widest, me.spacing[i]);
        });
        touched[g] = {};
        Gathered<6> near;  // place, spacing, point, shift
        for (const Layer& layer : other.layer) {
            const double reach = 0.5 * (widest + layer.widest);
            if (layer.map.grid.entries == 0 || layer.map.bound(box.middle()) >= reach + norm(box.half())) continue;
            ranges(layer.map.grid, box, reach, [&](std::int64_t first, std::int64_t last) {
                for (std::int64_t k = first; k < last && near.all; ++k) {
                    const std::int64_t point = layer.points[layer.map.grid.index[k]];
                    const double shift = layer.map.grid.shift[k], x = other.points.place[0][point], y = other.points.place[1][point], z = other.points.place[2][point] + shift;
                    if (apart2(box, x, y, z) < reach * reach) near.take({x, y, z, other.spacing[other.points.particle(point)], static_cast<double>(point), shift});
                }
            });
        }
        if (near.all && near.count == 0) return;
        const SortedView<6> v = near.view();
        me.groups.each(g, [&](std::int64_t i) {
            Felt felt;
            if (near.all) touch_gathered(i, v, near.count, felt, touched[g]);
            else touch_all(i, felt, touched[g]);
            for (int a = 0; a < 3; ++a) me.f[a][i] += felt.f[a];
            me.press[i] += felt.press;
            me.near[i] += felt.near;
        });
    }

private:
    struct Felt {
        double f[3] = {0, 0, 0}, press = 0, near = 0;
    };
    BRISANCE_HD void touch_gathered(std::int64_t i, const SortedView<6>& near, int count, Felt& felt, Touched& local) const {
        using V = Pack<double>;
        const double x = me.body.x[0][i], y = me.body.x[1][i], z = me.body.x[2][i], kappa = me.spacing[i];
        for (int q = 0; q < count; q += lanes<double>) {
            const V dx = x - near(0, q), dy = y - near(1, q), dz = z - near(2, q), d = 0.5 * (kappa + near(3, q));
            each_lane(lane_bits((dx * dx + dy * dy + dz * dz < d * d) & lanes_before<V>(q, count)), [&](int l) {
                touch(i, static_cast<std::int64_t>(near.columns[4][q + l]), near.columns[5][q + l], felt, local);
            });
        }
    }
    BRISANCE_HD void touch_all(std::int64_t i, Felt& felt, Touched& local) const {
        const FluidView& p = me.body;
        for (const Layer& layer : other.layer)
            layer.map.grid.ranges(p.x[0][i], p.x[1][i], p.x[2][i], 0.5 * (me.spacing[i] + layer.widest), [&](std::int64_t first, std::int64_t last) {
                for (std::int64_t k = first; k < last; ++k) touch(i, layer.points[layer.map.grid.index[k]], layer.map.grid.shift[k], felt, local);
            });
    }
    /// Particle i and a point of the other side, shifted along z.
    BRISANCE_HD void touch(std::int64_t i, std::int64_t point, double shift, Felt& felt, Touched& local) const {
        const FluidView &p = me.body, &q = other.body;
        const std::int64_t j = other.points.particle(point);
        const double dx = p.x[0][i] - other.points.place[0][point], dy = p.x[1][i] - other.points.place[1][point], dz = p.x[2][i] - other.points.place[2][point] - shift;
        const double r2 = dx * dx + dy * dy + dz * dz, d = 0.5 * (me.spacing[i] + other.spacing[j]);
        if (r2 >= d * d || r2 < 1e-24) return;
        const double r = std::sqrt(r2), overlap = d - r, deep = overlap / d;
        const double m_star = series(p.mass[i], q.mass[j]);
        const double stiffness = o.stiffness * std::max(4 * series(me.modulus[i], other.modulus[j]) * d, hardest(m_star, o));
        // progressive: k (1 + 3 (overlap/d)^2)
        const double spring = stiffness * overlap * (1 + 3 * deep * deep);
        const auto velocity = [&](int axis) { return p.v_now[axis][i] - other.points.sign(point, axis) * q.v_now[axis][j]; };
        const double vn = (velocity(0) * dx + velocity(1) * dy + velocity(2) * dz) / r;
        const double force = std::max(spring - 2 * damping_ratio(p.rho_now[i], q.rho_now[j], o) * std::sqrt(stiffness * m_star) * vn, 0.0) / r;
        felt.f[0] += force * dx;
        felt.f[1] += force * dy;
        felt.f[2] += force * dz;
        felt.press += overlap * q.pressure[j];
        felt.near += overlap;
        local.stored += 0.5 * stiffness * overlap * overlap * (1 + 1.5 * deep * deep);
        local.overlap = std::max(local.overlap, overlap);
        ++local.touching;
    }
};

}  // namespace

ContactReport node_contact(const FluidBody& a, const FluidBody& b, const ContactOptions& o, FluidForces& fa, FluidForces& fb) {
    static Sorted sorted[2];
    static Array<Touched> touched;
    const double largest = std::max(fa.largest_spacing, fb.largest_spacing);
    const Side sides[2] = {side(a, fa, sorted[0], largest, b.size()), side(b, fb, sorted[1], largest, a.size())};
    ContactReport report;
    for (int m = 0; m < 2; ++m) {
        const std::int64_t groups = sides[m].groups.size;
        make_room(touched, static_cast<std::size_t>(groups));
        Touched* const of = touched.data();
        exec::launch(groups, NodeKernel{sides[m], sides[1 - m], o, of}, few_groups);
        const Touched t = exec::launch_sum(groups, Touched{}, BRISANCE_KERNEL(std::int64_t g) { return of[g]; });
        report.stored += 0.5 * t.stored;
        report.penetration = std::max(report.penetration, t.overlap);
        report.touching = t.touching;
    }
    return report;
}

}  // namespace brisance
