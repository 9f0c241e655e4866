// SPDX-License-Identifier: Apache-2.0
#include "contact/contact.h"

#include "neighbours/deformation.h"

#include <algorithm>
#include <cmath>

namespace brisance {

template <class R>
Surface make_surface(const SolidBody<R>& b) {
    Surface s;
    for (std::size_t c = 0; c < b.layout.columns.size(); ++c) {
        const Column& column = b.layout.columns[c];
        if (column.wall_layer != 0) continue;
        for (int k = 0; k < column.layers; ++k) {
            const std::int64_t slot = column.start + k;
            if (!(b.layout.flags[static_cast<std::size_t>(slot)] & slot_own)) continue;
            s.slot.push_back(slot);
            s.column.push_back(static_cast<std::int32_t>(c));
            s.mass.push_back(b.mass(column));
            s.area.push_back(column.wall_length * b.layout.dz);
            s.spacing.push_back(column.spacing);
            s.dz.push_back(b.layout.dz);
            s.depth.push_back(3 * column.wall_distance);
            s.modulus.push_back(b.material.longitudinal_modulus());
            s.z_reference.push_back(column.z0 + k * b.layout.dz);
        }
    }
    for (auto* a : {&s.x, &s.y, &s.z, &s.nx, &s.ny, &s.nz, &s.vx, &s.vy, &s.vz, &s.fx, &s.fy, &s.fz, &s.ix, &s.iy, &s.iz, &s.jx, &s.jy, &s.jz}) a->assign(s.size(), 0);
    return s;
}

template <class R>
void follow(Surface& s, const SolidBody<R>& b, const ColumnPairs<R>& pairs, double ahead) {
    exec::for_each(static_cast<std::int64_t>(s.size()), [&](std::int64_t i) {
        const auto p = static_cast<std::size_t>(i), slot = static_cast<std::size_t>(s.slot[p]), c = static_cast<std::size_t>(s.column[p]);
        const Column& column = b.layout.columns[c];
        const Mat3<double> f = deformation_gradient(b, pairs, c, slot);
        const Vec3<double> normal{column.wall_normal_x, column.wall_normal_y, 0};
        Vec3<double> n = cofactor(f) * normal;
        double length = norm(n), jacobian = det(f);
        if (!(b.live[slot] > R(0)) || !(length > 0.2 && length < 5 && jacobian > 0.2 && jacobian < 5) || dot(n, normal) < 0.3 * length) {
            n = normal;  // a crushed particle's gradient says nothing of the wall any more
            length = jacobian = 1;
        }
        // A torn particle is no wall: debris in the midst of gas would be pushed from one side only. Its neighbours on the wall cover its place.
        s.area[p] = b.live[slot] > R(0) ? column.wall_length * b.layout.dz : 0.0;
        const double delta = column.wall_distance * std::clamp(jacobian / length, 0.5, 1.5);
        s.nx[p] = n.x / length;
        s.ny[p] = n.y / length;
        s.nz[p] = n.z / length;
        s.vx[p] = static_cast<double>(b.v[0][slot]);
        s.vy[p] = static_cast<double>(b.v[1][slot]);
        s.vz[p] = static_cast<double>(b.v[2][slot]);
        s.x[p] = column.x + static_cast<double>(b.u[0][slot]) + ahead * s.vx[p] + delta * s.nx[p];
        s.y[p] = column.y + static_cast<double>(b.u[1][slot]) + ahead * s.vy[p] + delta * s.ny[p];
        s.z[p] = s.z_reference[p] + static_cast<double>(b.u[2][slot]) + ahead * s.vz[p] + delta * s.nz[p];
        s.fx[p] = s.fy[p] = s.fz[p] = 0;
    }, 256);
}

void plan(Surface& s, double kick) {
    for (std::size_t p = 0; p < s.size(); ++p) {
        // what a long step had foreseen and contact never gave is taken back
        s.ix[p] = kick * s.fx[p] - s.jx[p];
        s.iy[p] = kick * s.fy[p] - s.jy[p];
        s.iz[p] = kick * s.fz[p] - s.jz[p];
        s.jx[p] = s.jy[p] = s.jz[p] = 0;
    }
}

void plan_ahead(Surface& s, double step) {
    for (std::size_t p = 0; p < s.size(); ++p) {
        const double x = 0.5 * step * s.fx[p], y = 0.5 * step * s.fy[p], z = 0.5 * step * s.fz[p];
        s.ix[p] = x - s.jx[p];
        s.iy[p] = y - s.jy[p];
        s.iz[p] = z - s.jz[p];
        s.jx[p] = x;
        s.jy[p] = y;
        s.jz[p] = z;
    }
}

void give(Surface& s, double kick) {
    for (std::size_t p = 0; p < s.size(); ++p) {
        s.jx[p] -= kick * s.fx[p];
        s.jy[p] -= kick * s.fy[p];
        s.jz[p] -= kick * s.fz[p];
    }
}

template <class R>
void push(const Surface& s, SolidBody<R>& b, double kick) {
    for (std::size_t p = 0; p < s.size(); ++p) {
        const auto slot = static_cast<std::size_t>(s.slot[p]);
        const double i[3] = {s.ix[p] / s.mass[p], s.iy[p] / s.mass[p], s.iz[p] / s.mass[p]};
        for (std::size_t k = 0; k < 3; ++k) {
            b.v[k][slot] += static_cast<R>(i[k]);
            if (b.options.pairwise) b.acceleration[k][slot] += static_cast<R>(i[k] / kick);
        }
    }
}

template <class R>
double half_work(const Surface& s, const SolidBody<R>& b) {
    double work = 0;
    for (std::size_t p = 0; p < s.size(); ++p) {
        const auto slot = static_cast<std::size_t>(s.slot[p]);
        work += s.ix[p] * static_cast<double>(b.v[0][slot]) + s.iy[p] * static_cast<double>(b.v[1][slot]) + s.iz[p] * static_cast<double>(b.v[2][slot]);
    }
    return 0.5 * work;
}

template Surface make_surface(const SolidBody<double>&);
template Surface make_surface(const SolidBody<float>&);
template void follow(Surface&, const SolidBody<double>&, const ColumnPairs<double>&, double);
template void follow(Surface&, const SolidBody<float>&, const ColumnPairs<float>&, double);
template void push(const Surface&, SolidBody<double>&, double);
template void push(const Surface&, SolidBody<float>&, double);
template double half_work(const Surface&, const SolidBody<double>&);
template double half_work(const Surface&, const SolidBody<float>&);

}  // namespace brisance
