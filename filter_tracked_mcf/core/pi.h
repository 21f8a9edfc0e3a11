// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace tracked_mcf
