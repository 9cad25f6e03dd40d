#include "fuzz/scenes/built_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "ccd/error.hpp"
#include "fuzz/scenes/built_in_themes.hpp"

namespace nearmiss {

namespace {

/// The entry that a text names; nullptr where there is none.
const BuiltIn* find(std::string_view text) {
  const auto& all = built_in_scenes();
  const auto found = std::find_if(all.begin(), all.end(), [&](const BuiltIn& each) {
    return each.name == text.substr(0, text.find('@'));
  });
  return found == all.end() ? nullptr : &*found;
}

int parse_size(const std::string& text, const BuiltIn& scene) {
  const std::string_view word = std::string_view(text).substr(scene.name.size() + 1);
  int size = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), size);
  const bool number = error == std::errc() && end == word.data() + word.size();
  if (!number || size < scene.smallest || size > scene.largest)
    throw Error(fmt::format("{}: found size {}, expected {} to {}", text,
                            number ? std::string(word) : fmt::format("'{}'", word), scene.smallest,
                            scene.largest));
  return size;
}

}  // namespace

const std::vector<BuiltIn>& built_in_scenes() {
  static const std::vector<BuiltIn> all = [] {
    std::vector<BuiltIn> scenes;
    for (const auto theme : {cloth_scenes, twisted_scenes, body_scenes})
      for (BuiltIn& scene : theme()) scenes.push_back(std::move(scene));
    return scenes;
  }();
  return all;
}

bool is_built_in_scene(const std::string& text) { return find(text) != nullptr; }

Scene built_in_scene(const std::string& text) {
  const BuiltIn* built_in = find(text);
  if (built_in == nullptr) throw Error(fmt::format("{}: found no built-in scene of that name", text));
  Scene scene = built_in->make(text == built_in->name ? built_in->default_size : parse_size(text, *built_in));
  scene.name = text;
  return scene;
}

Scene scene_of_formula(std::size_t frames, Mesh primitives, std::function<Points(double frame)> points) {
  primitives.points = points(0);
  return {.name = {},
          .frames = frames,
          .mesh = std::move(primitives),
          .points = [points = std::move(points)](std::size_t frame) {
            return points(static_cast<double>(frame));
          }};
}

}  // namespace nearmiss
