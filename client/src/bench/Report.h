#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Table.h"

/// Tables for programs, and pages for people.
namespace gnomon::client {

/// One header, then a line a row of each table.
std::string benchCsv(const std::vector<BenchTable>& tables);
std::string benchJson(const std::vector<BenchTable>& tables);
/// For a terminal.
std::string benchText(const BenchTable& table);
/// A page with plots, tables, and pictures; needs no server and nothing from elsewhere.
std::string benchHtml(const std::vector<BenchTable>& tables);

/// index.html, table.csv, table.json and of each table plot-SLUG.svg and plot-SLUG.png into a
/// folder, made where missing. @throws Failure Errc::file
void writeBenchReport(const std::filesystem::path& folder, const std::vector<BenchTable>& tables);

}  // namespace gnomon::client
