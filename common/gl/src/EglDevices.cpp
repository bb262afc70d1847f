#include "EglDevices.h"

#include <fmt/core.h>

#include <array>

namespace gnomon::gl {
namespace {

std::string describe(EGLDeviceEXT device, PFNEGLQUERYDEVICESTRINGEXTPROC queryString,
                     const char* extensions) {
    if (contains(extensions, "EGL_MESA_device_software")) return "software";
    std::string text;
    const auto add = [&](const char* extension, EGLint attribute) {
        // Asking without the extension is an error that some drivers print.
        if (!contains(extensions, extension)) return;
        const char* value = queryString(device, attribute);
        if (value == nullptr || *value == '\0') return;
        if (!text.empty()) text += ' ';
        text += value;
    };
    add("EGL_EXT_device_query_name", EGL_RENDERER_EXT);
    add("EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT);
    return text.empty() ? "unnamed device" : text;
}

}  // namespace

std::vector<EglDevice> eglDevices() {
    const auto queryDevices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto queryString = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        eglGetProcAddress("eglQueryDeviceStringEXT"));
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const bool canEnumerate = contains(client, "EGL_EXT_device_base") ||
                              (contains(client, "EGL_EXT_device_enumeration") &&
                               contains(client, "EGL_EXT_device_query"));
    EGLint count = 0;
    if (!canEnumerate || queryDevices == nullptr || queryString == nullptr ||
        queryDevices(0, nullptr, &count) == EGL_FALSE || count <= 0)
        return {};
    std::vector<EGLDeviceEXT> handles(static_cast<std::size_t>(count));
    if (queryDevices(count, handles.data(), &count) == EGL_FALSE) return {};
    handles.resize(static_cast<std::size_t>(count));

    std::vector<EglDevice> devices;
    for (EGLDeviceEXT handle : handles) {
        const char* extensions = queryString(handle, EGL_EXTENSIONS);
        devices.push_back({.handle = handle,
                           .name = describe(handle, queryString, extensions),
                           .software = contains(extensions, "EGL_MESA_device_software")});
    }
    return devices;
}

std::string listed(const std::vector<EglDevice>& devices) {
    if (devices.empty()) return "none";
    std::string text;
    for (std::size_t i = 0; i < devices.size(); ++i)
        text += fmt::format("{}{}: {}", i == 0 ? "" : "; ", i, devices[i].name);
    return text;
}

bool contains(const char* extensions, std::string_view name) {
    std::string_view rest = extensions != nullptr ? extensions : "";
    while (!rest.empty()) {
        const auto end = rest.find(' ');
        if (rest.substr(0, end) == name) return true;
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    return false;
}

std::string eglErrorName() {
    constexpr std::array names{
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
        "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
        "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
        "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
    const EGLint error = eglGetError();
    const auto index = static_cast<std::size_t>(error - EGL_SUCCESS);  // the codes are consecutive
    return index < names.size() ? names[index] : fmt::format("EGL error {:#x}", error);
}

}  // namespace gnomon::gl
