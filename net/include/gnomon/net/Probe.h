#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/net/ClusterKey.h>
#include <gnomon/net/HubTypes.h>

#include <chrono>
#include <vector>

namespace gnomon::net {

/// Asks all servers at once whether they are there and, where there is a key, have it, too. Begins
/// no session: who is shown something goes on.
/// @return for each address, in their order: nothing, or why not
std::vector<Result<void>> probe(const std::vector<ServerAddress>& servers, const SharedKey& key,
                                std::chrono::milliseconds limit);

}  // namespace gnomon::net
