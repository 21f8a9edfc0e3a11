// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/presentation/report_table.h"
#include "tests/zoo/zoo_case.h"

namespace tracked_mcf::zoo {

/// Returns which number of a report is not what the meshes before and after a filter show, as
/// measured here anew; empty if all are. The reports of all filters have these numbers.
std::string wrong_number(const Case& filtered, const TriangleMesh& after,
                         const ReportObject& report);

/// Returns the key of a number that is not finite, or null although its table does not allow that;
/// empty if there is none.
std::string key_without_number(const ReportObject& report);

/// Returns which number differs in the report of the same mesh, of which the lengths are `unit`
/// times as many; empty if none does. `size` is that of the first mesh. With another order of
/// vertices, what a sample of them estimates may differ. Counts must be equal,
/// lengths and the like up to `tolerance`. Numbers of the machine and of the solver's way may
/// differ.
std::string differing_number(const ReportObject& report, const ReportObject& other, double unit,
                             double size, double tolerance, bool is_reordered);

}  // namespace tracked_mcf::zoo
