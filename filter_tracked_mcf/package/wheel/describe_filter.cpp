// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the docstring of the filter's Python method.
#include <iostream>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/parameters/pymeshlab_help.h"

int main() {
    std::cout << tracked_mcf::pymeshlab_help<tracked_mcf::FlowParameters>();
}
