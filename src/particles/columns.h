// SPDX-License-Identifier: Apache-2.0
// Where total-Lagrangian particles live: points in the x-y section, each carrying a contiguous column of equally spaced particles
// along z. The neighbour of a particle is found by arithmetic, for ever.
#pragma once

#include "exec/memory.h"
#include "math/pack.h"

#include <cstdint>
#include <string>
#include <vector>

namespace brisance {

/// One column of particles. A particle's slot is start + k for layer k.
struct Column {
    double x = 0, y = 0;   ///< reference position, mm
    double z0 = 0;         ///< of layer 0, mm
    double area = 0;       ///< of the section, mm2
    double spacing = 0;    ///< in the section, mm
    int layers = 0;
    std::int64_t start = 0;  ///< slot of layer 0; a multiple of the tile width
    double wall_length = 0;  ///< mm of wall that a column of the first layer stands for; 0 elsewhere
    double wall_distance = 0;              ///< to the nearest wall of the part, mm
    double wall_normal_x = 0, wall_normal_y = 0;
    int wall_layer = -1;                   ///< 0: first layer at a wall; -1: inside
};

/// `width` consecutive slots of one column: one SIMD pack, or several.
struct Tile {
    std::int64_t base = 0;
    std::int32_t column = 0;
    bool masked = false;  ///< some neighbour of some lane is missing: weights are multiplied by `live`
};

enum SlotFlag : std::uint8_t {
    slot_own = 1,   ///< a particle (not padding, not a periodic image)
    slot_torn = 2,  ///< taken out of the sums by the guard
    slot_low = 4, slot_high = 8,  ///< first and last particle of its column
};

/// Lanes of a tile: those of a pack; where a pack is one number, as many as fill the sectors that a warp loads.
template <class R> inline constexpr int tile_width = lanes<R> == 1 ? 8 : lanes<R>;

/// The layout of a body: columns, padded such that the neighbours of every lane of every tile are valid slots.
struct Columns {
    Array<Column> columns;
    Array<Tile> tiles;
    Array<std::uint8_t> flags;  ///< by slot
    double dz = 0;              ///< mm
    double z_low = 0;           ///< layer k stands for z_low + k dz ... z_low + (k+1) dz, wherever in it its particle is, mm
    bool periodic = false;      ///< layers repeat with period layers * dz (all columns alike)
    int width = 8;              ///< lanes of a tile
    int pad = 3;                ///< largest offset along a column
    std::int64_t slots = 0;
    std::int64_t particles = 0;
};

/// Gives every column its slots and cuts the tiles; `present(column, layer)` tells which places hold a particle. The empty slots between two
/// columns serve both: what reaches beyond the end of one must not meet the other. Only periodic images need places of their own.
template <class Present>
void lay_out(Columns& c, Present&& present) {
    std::int64_t next = 0;
    const auto round_up = [&](std::int64_t n) { return (n + c.width - 1) / c.width * c.width; };
    for (Column& column : c.columns) {
        column.start = round_up(next + c.pad);
        next = column.start + (c.periodic ? round_up(column.layers) + c.pad : column.layers);
    }
    c.slots = round_up(next + c.pad) + c.width;
    c.flags.assign(static_cast<std::size_t>(c.slots), 0);
    c.tiles.clear();
    c.particles = 0;
    for (std::size_t i = 0; i < c.columns.size(); ++i) {
        const Column& column = c.columns[i];
        int first = -1, last = -1;
        for (int k = 0; k < column.layers; ++k) {
            if (!present(column, k)) continue;
            c.flags[static_cast<std::size_t>(column.start + k)] |= slot_own;
            ++c.particles;
            if (first < 0) first = k;
            last = k;
        }
        if (first >= 0) {
            c.flags[static_cast<std::size_t>(column.start + first)] |= slot_low;
            c.flags[static_cast<std::size_t>(column.start + last)] |= slot_high;
        }
        for (int k = 0; k < column.layers; k += c.width) c.tiles.push_back({column.start + k, static_cast<std::int32_t>(i), false});
    }
}

}  // namespace brisance
