#pragma once

#include <gnomon/field/Type.h>

#include <vector>

namespace gnomon::fuzz {

/// The scene's types, and two that are only known from a schema.
field::TypeRegistry fuzzTypes();
/// Theirs, in an order that does not change as long as the types do not.
std::vector<field::TypeId> fuzzTypeIds();

}  // namespace gnomon::fuzz
