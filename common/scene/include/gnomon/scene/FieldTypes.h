#pragma once

#include <gnomon/field/FieldTraits.h>
#include <gnomon/math/Types.h>
#include <gnomon/math/View.h>

/// How the mathematical types of a scene travel in fields.
namespace gnomon::field {

template <int n, class T>
struct FieldTraits<glm::vec<n, T>> {
    static constexpr std::string_view all = std::is_same_v<T, float>    ? "ffff"
                                            : std::is_same_v<T, double> ? "dddd"
                                                                        : "iiii";
    static constexpr std::string_view layout = all.substr(0, n);
    static void write(Writer& to, const glm::vec<n, T>& v) {
        for (int i = 0; i < n; ++i) to.scalar(v[i]);
    }
    static glm::vec<n, T> read(Reader& from) {
        glm::vec<n, T> v;
        for (int i = 0; i < n; ++i) v[i] = from.scalar<T>();
        return v;
    }
};

/// Column-major.
template <>
struct FieldTraits<glm::dmat4> {
    static constexpr std::string_view layout = "dddddddddddddddd";
    static void write(Writer& to, const glm::dmat4& m) {
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) to.scalar(m[c][r]);
    }
    static glm::dmat4 read(Reader& from) {
        glm::dmat4 m;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) m[c][r] = from.scalar<double>();
        return m;
    }
};

/// Translation (3 doubles), then the 3x3 part column-major (9 floats): 60 bytes.
template <>
struct FieldTraits<math::Affine> {
    static constexpr std::string_view layout = "dddfffffffff";
    static void write(Writer& to, const math::Affine& a) {
        for (int i = 0; i < 3; ++i) to.scalar(a.translation[i]);
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) to.scalar(a.linear[c][r]);
    }
    static math::Affine read(Reader& from) {
        math::Affine a;
        for (int i = 0; i < 3; ++i) a.translation[i] = from.scalar<double>();
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) a.linear[c][r] = from.scalar<float>();
        return a;
    }
};

template <>
struct FieldTraits<math::Rect> {
    static constexpr std::string_view layout = "dddd";
    static void write(Writer& to, const math::Rect& r) {
        for (const double v : {r.left, r.bottom, r.width, r.height}) to.scalar(v);
    }
    static math::Rect read(Reader& from) {
        math::Rect r;
        for (double* v : {&r.left, &r.bottom, &r.width, &r.height}) *v = from.scalar<double>();
        return r;
    }
};

}  // namespace gnomon::field
