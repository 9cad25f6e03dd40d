#include "fuzz/scenes/built_in/built_in_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/scenes/built_in/themes.hpp"

namespace nearmiss {

namespace {

int parse_size(const std::string& text, const BuiltInScene& scene) {
  const std::string_view word = std::string_view(text).substr(scene.name.size() + 1);
  const auto size = parse_integer<int>(word);
  if (!size || *size < scene.smallest || *size > scene.largest)
    throw Error(fmt::format("{}: found size {}, expected {} to {}", text,
                            size ? std::string(word) : fmt::format("'{}'", excerpt(word)), scene.smallest,
                            scene.largest));
  return *size;
}

}  // namespace

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> all = [] {
    std::vector<BuiltInScene> scenes;
    for (const auto theme : {cloth_scenes, twisted_scenes, body_scenes})
      for (BuiltInScene& scene : theme()) scenes.push_back(std::move(scene));
    return scenes;
  }();
  return all;
}

const BuiltInScene* find_scene(std::string_view text, std::span<const BuiltInScene> among) {
  const auto found = std::ranges::find(among, text.substr(0, text.find('@')), &BuiltInScene::name);
  return found == among.end() ? nullptr : &*found;
}

Scene make_scene(const std::string& text, const BuiltInScene& scene) {
  Scene made = scene.make(text == scene.name ? scene.default_size : parse_size(text, scene));
  made.name = text;
  return made;
}

bool is_built_in_scene(const std::string& text) { return find_scene(text, built_in_scenes()) != nullptr; }

Scene built_in_scene(const std::string& text) {
  const BuiltInScene* built_in = find_scene(text, built_in_scenes());
  if (built_in == nullptr) throw Error(fmt::format("{}: found no built-in scene of that name", text));
  return make_scene(text, *built_in);
}

Scene scene_of_formula(std::size_t frames, Mesh primitives, std::function<PointList(double frame)> points) {
  primitives.points = points(0);
  return {.name = {},
          .frames = frames,
          .mesh = std::move(primitives),
          .points = [points = std::move(points)](std::size_t frame) {
            return points(static_cast<double>(frame));
          }};
}

}  // namespace nearmiss
