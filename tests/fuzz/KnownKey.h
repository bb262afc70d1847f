#pragma once

#include <gnomon/net/ClusterKey.h>

#include <memory>
#include <string>

namespace gnomon::fuzz {

/// The cluster key of targets and seeds; @p digit tells several apart.
inline net::SharedKey knownKey(char digit = '1') {
    auto key = net::ClusterKey::parse("gnomon-key-1 " + std::string(64, digit));
    return std::make_shared<const net::ClusterKey>(orThrow(std::move(key)));
}

}  // namespace gnomon::fuzz
