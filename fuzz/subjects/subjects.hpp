// All subjects: the built-in ones and published CCDs by name, plug-ins by path or command.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/subjects/named.hpp"

namespace nearmiss {

/// The plug-in that a text [NAME=]SUBJECT names: SUBJECT is its path or command, or the name of a published
/// CCD, which stands for the plug-in built from that CCD's adapter (peers.hpp). Returns nothing for other
/// subjects. Throws Error if the published CCD is not built.
std::optional<std::string> plugin_named(std::string_view text);

/// Makes the subject of a text [NAME=]SUBJECT, and gives it the NAME if there is one. The subject is a
/// built-in subject (make_built_in()) or a plug-in (plugin_named()), which runs in processes of its own
/// (isolation/) under `limits`. Throws Error for an unknown subject, and for a shared object with several
/// detectors if the text does not choose one.
std::unique_ptr<Subject> make_any_subject(std::string_view text,
                                          std::optional<double> given_bound = std::nullopt,
                                          const isolation::PluginLimits& limits = {});

/// Like make_any_subject, but if the text names a shared object without NAME= and chooses none of its
/// detectors, this function makes a subject of each detector of the shared object.
std::vector<std::unique_ptr<Subject>> make_any_subjects(std::string_view text,
                                                        std::optional<double> given_bound = std::nullopt,
                                                        const isolation::PluginLimits& limits = {});

/// Whether a name belongs to a built-in subject or to a published CCD. If options or a bound follow the name,
/// they are ignored.
bool is_built_in_name(std::string_view name);

/// Renames plug-ins with equal names, such as versions of one CCD, and plug-ins with a built-in name. Each
/// such plug-in gets the name of its file, unless the command line gave it a NAME: "v1" for ./v1.so, or
/// "v1.DETECTOR" if the file has several detectors or the detector was chosen. Throws Error if two subjects
/// still have the same name, or a plug-in still has a built-in name.
void tell_apart(std::vector<std::unique_ptr<Subject>>& subjects);

/// The name that the subject has by itself, without a given NAME and without options; for a plug-in, this is
/// the name that the plug-in exports.
std::string own_name(const Subject& subject);

/// The text [NAME=]SUBJECT, such as "v1=./v1.so", that makes this subject under its present name, even if the
/// command line has other subjects. It has no NAME= if the subject was not renamed.
std::string text_of(const Subject& subject);

}  // namespace nearmiss
