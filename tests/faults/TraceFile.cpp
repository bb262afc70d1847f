#include "TraceFile.h"

#include <gnomon/base/Error.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gnomon::faults {
namespace {

bool names(const std::string& list, const std::string& name) {
    std::istringstream words{list};
    for (std::string word; words >> word;)
        if (word == name) return true;
    return false;
}

}  // namespace

TraceFile::TraceFile(const std::string& file) {
    std::ifstream in{file};
    std::string line;
    if (!std::getline(in, line) || line != "frame,s,ms,members,dropped,joined")
        throw Failure{Errc::file, file + ": no trace, its first line is \"" + line + "\""};
    while (std::getline(in, line)) {
        std::replace(line.begin(), line.end(), ' ', ';');
        std::istringstream fields{line};
        Row row;
        char comma = 0;
        fields >> row.frame >> comma >> row.s >> comma >> row.ms >> comma >> row.members >> comma;
        if (!fields) throw Failure{Errc::file, file + ": no line of a trace: " + line};
        std::getline(fields, row.dropped, ',');
        std::getline(fields, row.joined);
        for (auto* list : {&row.dropped, &row.joined})
            std::replace(list->begin(), list->end(), ';', ' ');
        rows_.push_back(row);
    }
}

std::size_t TraceFile::dropOf(const std::string& name, std::size_t from) const {
    while (from < rows_.size() && !names(rows_[from].dropped, name)) ++from;
    return from;
}

std::size_t TraceFile::joinOf(const std::string& name, std::size_t from) const {
    while (from < rows_.size() && !names(rows_[from].joined, name)) ++from;
    return from;
}

double TraceFile::longest(std::size_t from, std::size_t to) const {
    double ms = 0.0;
    for (std::size_t i = from; i < std::min(to, rows_.size()); ++i) ms = std::max(ms, rows_[i].ms);
    return ms;
}

double TraceFile::median(std::size_t from, std::size_t to) const {
    std::vector<double> all;
    for (std::size_t i = from; i < std::min(to, rows_.size()); ++i) all.push_back(rows_[i].ms);
    if (all.empty()) return 0.0;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

}  // namespace gnomon::faults
