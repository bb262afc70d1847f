#pragma once

#include <gnomon/field/Type.h>

namespace gnomon::scene {

/// Adds every container type of this module.
void addTypes(field::TypeRegistry& types);

}  // namespace gnomon::scene
