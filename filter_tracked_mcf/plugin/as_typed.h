// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

/// Returns the decimal number that a user typed where a host passes `value`. Many hosts round real
/// parameters to floats. A `value` that is a float becomes the double nearest to the float's
/// shortest decimal notation, 1e-5 for 9.99999974737875e-06, so that the plugin flows exactly as
/// the command-line tool does. Any other double is returned unchanged.
double as_typed(double value);

}  // namespace tracked_mcf
