// Published CCDs as subjects, by name (peers/README.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace nearmiss {

/// A published CCD that has an adapter.
struct Peer {
  std::string_view name;    ///< the name of the subject
  std::string_view object;  ///< the plug-in of this CCD is the file peers/OBJECT.so beside the program
  /// The Debian package that contains the CCD; "" if users compile the adapter themselves.
  std::string_view package;
  std::string_view adapter = object;  ///< fuzz/subjects/peers/ADAPTER.cpp
};

/// All published CCDs that have an adapter, whether their plug-ins are built or not.
std::span<const Peer> peers();

/// The published CCD with this name; options in the name are ignored.
std::optional<Peer> peer_named(std::string_view name);

std::string path_of(const Peer& peer);
bool is_built(const Peer& peer);
/// The instruction for building a published CCD: "install ..." or "run tools/subject ...".
std::string how_to_build(const Peer& peer);

/// The name of the plug-in for which the name of a published CCD stands. For example,
/// "tight-inclusion:tolerance=1e-3" stands for ".../peers/tight-inclusion.so:tight-inclusion:tolerance=1e-3".
/// Returns nothing if no published CCD has this name. Throws Error if the CCD's plug-in is not built.
std::optional<std::string> plugin_of_peer(std::string_view name);

}  // namespace nearmiss
