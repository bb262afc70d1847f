// Plots with Cairo: one hand draws both pictures.
#include <cairo-svg.h>
#include <cairo.h>
#include <gnomon/base/Error.h>

#include <fstream>
#include <memory>
#include <numbers>

#include "Plot.h"

namespace gnomon::client {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void paint(cairo_t* pen, const PlotColor& color) {
    cairo_set_source_rgb(pen, color[0], color[1], color[2]);
}

void draw(cairo_t* pen, const Plot::Line& line) {
    for (const auto& point : line.points) cairo_line_to(pen, point[0], point[1]);
    const double dash = 5.0;
    cairo_set_dash(pen, &dash, line.dashed ? 1 : 0, 0.0);
    cairo_set_line_width(pen, line.width);
    paint(pen, line.color);
    cairo_stroke(pen);
}

void draw(cairo_t* pen, const Plot::Mark& mark) {
    cairo_set_dash(pen, nullptr, 0, 0.0);
    if (mark.shape == Plot::Mark::Shape::circle) {
        cairo_new_sub_path(pen);
        cairo_arc(pen, mark.x, mark.y, mark.radius, 0.0, 2.0 * std::numbers::pi);
    } else {
        const double r = mark.radius * 1.3;
        cairo_move_to(pen, mark.x - r, mark.y);
        cairo_line_to(pen, mark.x, mark.y - r);
        cairo_line_to(pen, mark.x + r, mark.y);
        cairo_line_to(pen, mark.x, mark.y + r);
    }
    cairo_close_path(pen);
    paint(pen, mark.filled ? mark.color : PlotColor{1.0, 1.0, 1.0});
    cairo_fill_preserve(pen);
    cairo_set_line_width(pen, 1.8);
    paint(pen, mark.color);
    cairo_stroke(pen);
}

void draw(cairo_t* pen, const Plot::Text& text) {
    using Align = Plot::Text::Align;
    cairo_set_font_size(pen, text.size);
    cairo_text_extents_t extents{};
    cairo_text_extents(pen, text.text.c_str(), &extents);
    const double back = text.align == Align::left     ? 0.0
                        : text.align == Align::centre ? extents.x_advance / 2.0
                                                      : extents.x_advance;
    cairo_save(pen);
    cairo_translate(pen, text.x, text.y);
    if (text.upward) cairo_rotate(pen, -std::numbers::pi / 2.0);
    cairo_move_to(pen, -back, 0.0);
    paint(pen, text.color);
    cairo_show_text(pen, text.text.c_str());
    cairo_restore(pen);
}

void draw(cairo_surface_t* surface, const Plot& plot) {
    const Pen pen{cairo_create(surface), &cairo_destroy};
    paint(pen.get(), {1.0, 1.0, 1.0});
    cairo_paint(pen.get());
    cairo_select_font_face(pen.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    for (const auto& line : plot.lines) draw(pen.get(), line);
    for (const auto& mark : plot.marks) draw(pen.get(), mark);
    for (const auto& text : plot.texts) draw(pen.get(), text);
    if (const auto status = cairo_status(pen.get()); status != CAIRO_STATUS_SUCCESS)
        throw Failure{Errc::file,
                      std::string{"the plot cannot be drawn: "} + cairo_status_to_string(status)};
}

cairo_status_t append(void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string plotSvg(const Plot& plot) {
    std::string text;
    const Surface surface{
        cairo_svg_surface_create_for_stream(&append, &text, plot.width, plot.height),
        &cairo_surface_destroy};
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    draw(surface.get(), plot);
    cairo_surface_finish(surface.get());
    return text;
}

void writePlotPng(const std::filesystem::path& file, const Plot& plot) {
    constexpr double scale = 2.0;  // sharp on dense screens
    const Surface surface{
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(plot.width * scale),
                                   static_cast<int>(plot.height * scale)),
        &cairo_surface_destroy};
    cairo_surface_set_device_scale(surface.get(), scale, scale);
    draw(surface.get(), plot);
    const auto status = cairo_surface_write_to_png(surface.get(), file.c_str());
    if (status != CAIRO_STATUS_SUCCESS)
        throw Failure{Errc::file,
                      "cannot write " + file.string() + ": " + cairo_status_to_string(status)};
}

}  // namespace gnomon::client
