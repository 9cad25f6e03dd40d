// Published CCDs as subjects, by name (peers/README.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace nearmiss {

/// A published CCD that has an adapter.
struct Peer {
  std::string_view name;     ///< of the subject
  std::string_view object;   ///< its plug-in is peers/OBJECT.so beside the program
  std::string_view package;  ///< the Debian package that has the CCD; "" if users compile the adapter
  std::string_view adapter = object;  ///< fuzz/subjects/peers/ADAPTER.cpp
};

/// All published CCDs that have an adapter, whether built or not.
std::span<const Peer> peers();

/// The published CCD with this name; options in the name are ignored.
std::optional<Peer> peer_named(std::string_view name);

std::string path_of(const Peer& peer);
bool is_built(const Peer& peer);
/// How to build a published CCD: "install ..." or "run tools/subject ...".
std::string how_to_build(const Peer& peer);

/// The plug-in of a published CCD: "tight-inclusion:tolerance=1e-3" stands for
/// ".../peers/tight-inclusion.so:tight-inclusion:tolerance=1e-3". Returns nothing if no published CCD has
/// this name. Throws Error if the CCD is not built.
std::optional<std::string> plugin_of_peer(std::string_view name);

}  // namespace nearmiss
