#include "fuzz/subjects/peers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "ccd/query/error.hpp"
#include "fuzz/subjects/beside.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss {

namespace {

constexpr std::array<Peer, 25> all{{
    {.name = "fcl", .object = "fcl", .package = "libfcl-dev"},
    {.name = "fcl-newton", .object = "fcl", .package = "libfcl-dev"},
    {.name = "bullet", .object = "bullet", .package = "libbullet-dev"},
    {.name = "bullet-double", .object = "bullet-double", .package = "libbullet-dev", .adapter = "bullet"},
    {.name = "safeccd", .object = "safeccd", .package = ""},
    {.name = "root-parity", .object = "root-parity", .package = ""},
    {.name = "bsc", .object = "bsc", .package = ""},
    {.name = "tight-bound", .object = "tight-bound", .package = ""},
    {.name = "tight-inclusion", .object = "tight-inclusion", .package = ""},
    {.name = "msrf", .object = "msrf", .package = ""},
    {.name = "additive", .object = "additive", .package = ""},
    {.name = "mujoco", .object = "mujoco", .package = ""},
    {.name = "ipc-tight-inclusion", .object = "ipc-toolkit", .package = ""},
    {.name = "ipc-inexact", .object = "ipc-toolkit", .package = ""},
    {.name = "codim-ipc", .object = "codim-ipc", .package = ""},
    {.name = "libuipc", .object = "libuipc", .package = ""},
    {.name = "gipc", .object = "gipc", .package = ""},
    {.name = "ppf", .object = "ppf", .package = ""},
    {.name = "ctcd", .object = "ctcd", .package = ""},
    {.name = "eltopo", .object = "eltopo", .package = ""},
    {.name = "eltopo-root-parity", .object = "eltopo-root-parity", .package = "", .adapter = "eltopo"},
    {.name = "arcsim", .object = "arcsim", .package = ""},
    {.name = "dart", .object = "dart", .package = ""},
    {.name = "scalable-ccd", .object = "scalable-ccd", .package = ""},
    {.name = "scalable-ccd-float", .object = "scalable-ccd-float", .package = "", .adapter = "scalable-ccd"},
}};

}  // namespace

std::span<const Peer> peers() { return all; }

std::optional<Peer> peer_named(std::string_view name) {
  const auto* const peer = std::ranges::find(all, name.substr(0, name.find_first_of(":@")), &Peer::name);
  return peer == all.end() ? std::nullopt : std::optional(*peer);
}

std::string path_of(const Peer& peer) { return fmt::format("{}/{}.so", path_beside("peers"), peer.object); }

bool is_built(const Peer& peer) {
  std::error_code unknown;
  return std::filesystem::exists(path_of(peer), unknown);
}

std::string how_to_build(const Peer& peer) {
  return peer.package.empty()
             ? fmt::format(
                   "run tools/subject -o {} with the flags that fuzz/subjects/peers/{}.cpp gives, in "
                   "nearmiss's source tree",
                   shell_quoted(path_of(peer)), peer.adapter)
             : fmt::format("install {}, remove the build folder, and run tools/setup", peer.package);
}

std::optional<std::string> plugin_of_peer(std::string_view name) {
  const auto peer = peer_named(name);
  if (!peer) return std::nullopt;
  if (!is_built(*peer)) throw Error(fmt::format("'{}' is not built: {}", peer->name, how_to_build(*peer)));
  return fmt::format("{}:{}", path_of(*peer), name);
}

}  // namespace nearmiss
