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
  std::string_view object;   ///< its plug-in: the shared object peers/OBJECT.so beside the program
  std::string_view package;  ///< the Debian package that it is built with; "" if users compile its adapter
  std::string_view adapter = object;  ///< fuzz/subjects/peers/ADAPTER.cpp
};

/// All published CCDs that have an adapter, whether built or not.
std::span<const Peer> peers();

/// The published CCD with this name, apart from options.
std::optional<Peer> peer_named(std::string_view name);

/// The path of a published CCD's plug-in.
std::string path_of(const Peer& peer);
bool is_built(const Peer& peer);
/// How to build a published CCD, as an instruction: "compile ...".
std::string how_to_build(const Peer& peer);

/// The plug-in that a name stands for: "tight-inclusion:tolerance=1e-3" is
/// ".../peers/tight-inclusion.so:tight-inclusion:tolerance=1e-3". Nothing if the name is not that of a peer.
/// Throws Error if the peer is not built.
std::optional<std::string> plugin_of_peer(std::string_view name);

}  // namespace nearmiss
