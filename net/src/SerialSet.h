#pragma once

#include <boost/icl/interval_set.hpp>
#include <cstdint>

namespace gnomon::net {

/// Serials of uploads. They are given in turn and most are released in the end, so the intervals
/// are about as many as the uploads in use, however long a session lasts.
class SerialSet {
public:
    /// @return false where it was there before
    bool insert(std::uint64_t serial) {
        if (contains(serial)) return false;
        serials_.insert(serial);
        return true;
    }
    bool contains(std::uint64_t serial) const { return boost::icl::contains(serials_, serial); }
    std::size_t intervals() const { return serials_.iterative_size(); }

private:
    boost::icl::interval_set<std::uint64_t> serials_;
};

}  // namespace gnomon::net
