#include "reports/page/page.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <random>
#include <string_view>

#include "reports/text/json.hpp"

#if !__has_include("reports/page/node_modules/vega-embed/build/vega-embed.min.js")
#error "reports/page/node_modules is missing: run tools/setup, or npm ci in reports/page"
#endif

// NEARMISS_ASSET(name, file) puts a file of the page into the executable, and defines `name`, the file's
// text.
#define NEARMISS_ASSET(name, file)                    \
  asm(".pushsection .rodata, \"a\"\n" #name           \
      "_begin:\n"                                     \
      ".incbin \"" file "\"\n" #name                  \
      "_end:\n"                                       \
      ".popsection\n");                               \
  extern "C" const char name##_begin[], name##_end[]; \
  const std::string_view name(name##_begin, static_cast<std::size_t>(name##_end - name##_begin))

NEARMISS_ASSET(nearmiss_page_frame, NEARMISS_PAGE "/frame.html");
NEARMISS_ASSET(nearmiss_page_html, NEARMISS_PAGE "/page.html");
NEARMISS_ASSET(nearmiss_page_css, NEARMISS_PAGE "/page.css");
NEARMISS_ASSET(nearmiss_page_history_html, NEARMISS_PAGE "/history.html");
NEARMISS_ASSET(nearmiss_page_history, NEARMISS_PAGE "/history.js");
NEARMISS_ASSET(nearmiss_page_drawing, NEARMISS_PAGE "/drawing.js");
NEARMISS_ASSET(nearmiss_page_data, NEARMISS_PAGE "/data.js");
NEARMISS_ASSET(nearmiss_page_picker, NEARMISS_PAGE "/picker.js");
NEARMISS_ASSET(nearmiss_page_tables, NEARMISS_PAGE "/tables.js");
NEARMISS_ASSET(nearmiss_page_turning, NEARMISS_PAGE "/turning.js");
NEARMISS_ASSET(nearmiss_page_picture, NEARMISS_PAGE "/picture.js");
NEARMISS_ASSET(nearmiss_page_viewer, NEARMISS_PAGE "/viewer.js");
NEARMISS_ASSET(nearmiss_page_mesh, NEARMISS_PAGE "/mesh.js");
NEARMISS_ASSET(nearmiss_page_error_time, NEARMISS_PAGE "/error_time.js");
NEARMISS_ASSET(nearmiss_page_misses_time, NEARMISS_PAGE "/misses_time.js");
NEARMISS_ASSET(nearmiss_page_times, NEARMISS_PAGE "/times.js");
NEARMISS_ASSET(nearmiss_page_cases, NEARMISS_PAGE "/cases.js");
NEARMISS_ASSET(nearmiss_page_scenes, NEARMISS_PAGE "/scenes.js");
NEARMISS_ASSET(nearmiss_page_simulations, NEARMISS_PAGE "/simulations.js");
NEARMISS_ASSET(nearmiss_page_ladder, NEARMISS_PAGE "/ladder.js");
NEARMISS_ASSET(nearmiss_page_charts, NEARMISS_PAGE "/charts.js");
NEARMISS_ASSET(nearmiss_page_options, NEARMISS_PAGE "/options.js");
NEARMISS_ASSET(nearmiss_page_scorecard, NEARMISS_PAGE "/scorecard.js");
NEARMISS_ASSET(nearmiss_page_js, NEARMISS_PAGE "/page.js");
NEARMISS_ASSET(nearmiss_page_vega, NEARMISS_PAGE "/node_modules/vega/build/vega.min.js");
NEARMISS_ASSET(nearmiss_page_vega_lite, NEARMISS_PAGE "/node_modules/vega-lite/build/vega-lite.min.js");
NEARMISS_ASSET(nearmiss_page_vega_embed, NEARMISS_PAGE "/node_modules/vega-embed/build/vega-embed.min.js");

namespace nearmiss {

namespace {

void replace(std::string& text, std::string_view what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
}

/// A random word (nonce). By the page's content security policy, only scripts with this word run.
std::string make_nonce() {
  std::random_device random;
  std::string nonce;
  for (int i = 0; i < 4; ++i) nonce += fmt::format("{:08x}", random());
  return nonce;
}

/// JSON for a script element, with "<" escaped, because a browser would take "</script" in a string for the
/// end of the element.
std::string inside_script(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json_text(json)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

/// A page whose body is the HTML in `body`. The page has the JSON in an element with the id `data`, and the
/// scripts in `files`, which draw the JSON.
std::string page_of(std::string_view body, const char* data, const nlohmann::ordered_json& json,
                    std::initializer_list<std::string_view> files) {
  const std::string nonce = make_nonce();
  std::string scripts =
      fmt::format("<script type=\"application/json\" id=\"{}\">\n{}\n</script>", data, inside_script(json));
  for (const std::string_view each : files)
    scripts += fmt::format("<script nonce=\"{}\">\n{}\n</script>", nonce, each);
  std::string page(nearmiss_page_frame);
  replace(page, "NONCE", nonce);
  replace(page, "DATA", data);
  replace(page, "/* page.css */", std::string(nearmiss_page_css));
  replace(page, "<!-- body -->\n", std::string(body));
  replace(page, "<!-- scripts -->", scripts);
  return page;
}

}  // namespace

std::string report_page(const nlohmann::ordered_json& report) {
  return page_of(
      nearmiss_page_html, "report", report,
      {nearmiss_page_vega,       nearmiss_page_vega_lite,   nearmiss_page_vega_embed, nearmiss_page_data,
       nearmiss_page_tables,     nearmiss_page_drawing,     nearmiss_page_turning,    nearmiss_page_picture,
       nearmiss_page_viewer,     nearmiss_page_mesh,        nearmiss_page_picker,     nearmiss_page_charts,
       nearmiss_page_error_time, nearmiss_page_misses_time, nearmiss_page_times,      nearmiss_page_cases,
       nearmiss_page_scenes,     nearmiss_page_simulations, nearmiss_page_ladder,     nearmiss_page_options,
       nearmiss_page_scorecard,  nearmiss_page_js});
}

std::string history_page(const nlohmann::ordered_json& history) {
  return page_of(nearmiss_page_history_html, "history", history,
                 {nearmiss_page_vega, nearmiss_page_vega_lite, nearmiss_page_vega_embed, nearmiss_page_tables,
                  nearmiss_page_drawing, nearmiss_page_history});
}

}  // namespace nearmiss
