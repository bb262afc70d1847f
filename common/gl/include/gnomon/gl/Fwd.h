#pragma once

namespace gnomon::gl {

struct Api;
class Context;
struct ContextOptions;
enum class Backend : unsigned char;
class Window;

}  // namespace gnomon::gl
