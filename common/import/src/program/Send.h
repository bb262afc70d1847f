#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/ChangeList.h>
#include <gnomon/field/Type.h>

namespace gnomon::importer {

/// Writes the stream that format/Format.h describes. Errors: whatever write() says.
Result<void> send(const field::ChangeList& list, const field::TypeRegistry& types, int fd);

}  // namespace gnomon::importer
