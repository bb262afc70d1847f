#pragma once

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::gl {

/// A device of EGL_EXT_device_enumeration.
struct EglDevice {
    EGLDeviceEXT handle = EGL_NO_DEVICE_EXT;
    std::string name = {};  ///< what the driver tells of it: file, renderer, or "software"
    bool software = false;
};

/// All devices in the system's order; empty where EGL cannot list them.
std::vector<EglDevice> eglDevices();

/// "0: /dev/dri/card0; 1: software", or "none".
std::string listed(const std::vector<EglDevice>& devices);

/// True if the space-separated @p extensions, which may be null, contain @p name.
bool contains(const char* extensions, std::string_view name);

/// "EGL_BAD_MATCH" for the calling thread's last EGL error.
std::string eglErrorName();

}  // namespace gnomon::gl
