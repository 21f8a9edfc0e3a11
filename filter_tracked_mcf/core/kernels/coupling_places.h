#pragma once

#include <cstdint>

namespace tracked_mcf {

/// Where the entry between the functions at corners i and j of a cell is to be found in the
/// Couplings of the smaller of i and j.
struct CouplingPlaces {
    std::uint8_t place[8][8];
    std::uint8_t bit[8][8];  ///< of the pair, the same for (i, j) and (j, i); 31 if i is j
};

constexpr CouplingPlaces make_coupling_places() {
    CouplingPlaces places{};
    std::uint8_t pairs = 0;
    for (int i = 0; i < 8; ++i) {
        places.bit[i][i] = 31;
        for (int j = i + 1; j < 8; ++j) {
            // Towards the corners around one, numbered from -13 to 13.
            int offset = 0;
            for (int axis = 2; axis >= 0; --axis) {
                offset = 3 * offset + ((j >> axis) & 1) - ((i >> axis) & 1);
            }
            // Positive: the highest bit in which they differ is set in j, the larger number.
            places.place[i][j] = places.place[j][i] = static_cast<std::uint8_t>(offset);
            places.bit[i][j] = places.bit[j][i] = pairs++;
        }
    }
    return places;
}

constexpr CouplingPlaces kCouplingPlaces = make_coupling_places();

}  // namespace tracked_mcf
