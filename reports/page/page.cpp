#include "reports/page/page.hpp"

#include <fmt/format.h>

#include <random>
#include <string_view>

#include "reports/text/json.hpp"

#if !__has_include("reports/page/node_modules/vega-embed/build/vega-embed.min.js")
#error "reports/page/node_modules is missing: run tools/setup, or npm ci in reports/page"
#endif

// The executable contains the files of the page: NEARMISS_ASSET(name, file) defines name_begin and name_end.
#define NEARMISS_ASSET(name, file)          \
  asm(".pushsection .rodata, \"a\"\n" #name \
      "_begin:\n"                           \
      ".incbin \"" file "\"\n" #name        \
      "_end:\n"                             \
      ".popsection\n");                     \
  extern "C" const char name##_begin[], name##_end[]

NEARMISS_ASSET(nearmiss_page_html, NEARMISS_PAGE "/page.html");
NEARMISS_ASSET(nearmiss_page_css, NEARMISS_PAGE "/page.css");
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

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

void replace(std::string& text, std::string_view what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
}

/// A random word (nonce). The page's content policy lets only scripts with this word run.
std::string make_nonce() {
  std::random_device random;
  std::string nonce;
  for (int i = 0; i < 4; ++i) nonce += fmt::format("{:08x}", random());
  return nonce;
}

/// JSON for a script element, with "<" escaped: the browser would take "</script" for its end.
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

}  // namespace

std::string report_page(const nlohmann::ordered_json& report) {
  const std::string nonce = make_nonce();
  std::string scripts =
      fmt::format("<script type=\"application/json\" id=\"report\">\n{}\n</script>", inside_script(report));
  for (const std::string_view each : {between(nearmiss_page_vega_begin, nearmiss_page_vega_end),
                                      between(nearmiss_page_vega_lite_begin, nearmiss_page_vega_lite_end),
                                      between(nearmiss_page_vega_embed_begin, nearmiss_page_vega_embed_end),
                                      between(nearmiss_page_data_begin, nearmiss_page_data_end),
                                      between(nearmiss_page_tables_begin, nearmiss_page_tables_end),
                                      between(nearmiss_page_turning_begin, nearmiss_page_turning_end),
                                      between(nearmiss_page_picture_begin, nearmiss_page_picture_end),
                                      between(nearmiss_page_viewer_begin, nearmiss_page_viewer_end),
                                      between(nearmiss_page_mesh_begin, nearmiss_page_mesh_end),
                                      between(nearmiss_page_picker_begin, nearmiss_page_picker_end),
                                      between(nearmiss_page_charts_begin, nearmiss_page_charts_end),
                                      between(nearmiss_page_error_time_begin, nearmiss_page_error_time_end),
                                      between(nearmiss_page_misses_time_begin, nearmiss_page_misses_time_end),
                                      between(nearmiss_page_times_begin, nearmiss_page_times_end),
                                      between(nearmiss_page_cases_begin, nearmiss_page_cases_end),
                                      between(nearmiss_page_scenes_begin, nearmiss_page_scenes_end),
                                      between(nearmiss_page_simulations_begin, nearmiss_page_simulations_end),
                                      between(nearmiss_page_ladder_begin, nearmiss_page_ladder_end),
                                      between(nearmiss_page_options_begin, nearmiss_page_options_end),
                                      between(nearmiss_page_scorecard_begin, nearmiss_page_scorecard_end),
                                      between(nearmiss_page_js_begin, nearmiss_page_js_end)})
    scripts += fmt::format("<script nonce=\"{}\">\n{}\n</script>", nonce, each);
  std::string page(between(nearmiss_page_html_begin, nearmiss_page_html_end));
  replace(page, "NONCE", nonce);
  replace(page, "/* page.css */", std::string(between(nearmiss_page_css_begin, nearmiss_page_css_end)));
  replace(page, "<!-- scripts -->", scripts);
  return page;
}

}  // namespace nearmiss
