#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::faults {

/// A line of what `gnomon run --trace` wrote.
struct Row {
    std::uint64_t frame = 0;
    double s = 0.0;
    double ms = 0.0;
    int members = 0;
    std::string dropped = {};
    std::string joined = {};
};

class TraceFile {
public:
    /// @throws Failure the file is not what gnomon run writes
    explicit TraceFile(const std::string& file);

    const std::vector<Row>& rows() const { return rows_; }
    /// The index of the first row from @p from on that drops it, or where it joins; rows().size()
    /// where there is none.
    std::size_t dropOf(const std::string& name, std::size_t from = 0) const;
    std::size_t joinOf(const std::string& name, std::size_t from) const;
    double longest(std::size_t from, std::size_t to) const;
    double median(std::size_t from, std::size_t to) const;

private:
    std::vector<Row> rows_;
};

}  // namespace gnomon::faults
