// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the page of reports with their tables.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "filter_tracked_mcf/presentation/report_table.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

/// A row of the page: a key, and the names of the filters that have it.
struct PageRow {
    ReportKey key;
    std::vector<std::string> filters;
};

/// Adds the keys of a filter's report, in order.
template <class Report>
void add(const std::string& filter, std::vector<PageRow>& rows) {
    for (const ReportKey& key : report_table<Report>()) {
        const auto same = std::find_if(
            rows.begin(), rows.end(), [&](const PageRow& row) { return row.key.name == key.name; });
        if (same == rows.end()) {
            rows.push_back({key, {filter}});
        } else {
            EXPECT_EQ(same->key.meaning, key.meaning) << "of " << key.name << " in " << filter;
            same->filters.push_back(filter);
        }
    }
}

/// Returns the table that the page must have.
std::string table_of(const std::vector<PageRow>& rows) {
    std::ostringstream text;
    text << "| key | of | unit | meaning |\n|---|---|---|---|\n";
    for (const auto& [key, filters] : rows) {
        text << "| `" << key.name << "` | ";
        if (filters.size() == 3) text << "all";
        for (std::size_t i = 0; i < filters.size() && filters.size() < 3; ++i)
            text << (i > 0 ? ", " : "") << filters[i];
        text << " | " << unit_in_words(key.unit) << " | " << key.meaning << " |\n";
    }
    return text.str();
}

void expect_on_page(const std::string& table) {
    const std::string file = "filter_tracked_mcf/presentation/README.md";
    const std::string page = read_file(std::filesystem::path(TRACKED_MCF_SOURCE_DIR) / file);
    EXPECT_TRUE(page.find(table) != std::string::npos) << file << " needs this table:\n\n" << table;
}

TEST(ReportPage, HasAllKeys) {
    std::vector<PageRow> rows;
    add<FlowReport>("flow", rows);
    add<NoiseReport>("noise", rows);
    add<FairReport>("fair", rows);
    expect_on_page(table_of(rows));
}

TEST(ReportPage, HasTheKeysOfAStep) {
    std::vector<PageRow> rows;
    add<StepReport>("step", rows);
    expect_on_page(table_of(rows));
}

}  // namespace
}  // namespace tracked_mcf
