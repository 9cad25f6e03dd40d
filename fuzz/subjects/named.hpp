// Names of subjects: NAME=SUBJECT on the command line.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// Whether a text may be the NAME in NAME=SUBJECT. A NAME is a letter, then letters, digits, '_', '.' and
/// '-'.
bool is_given_name(std::string_view text);

/// A subject on the command line: [NAME=]SUBJECT. The text has a NAME if it contains '=' before any ':' or
/// '/'.
struct SubjectText {
  std::string name;  ///< "" if the text has no NAME
  std::string subject;

  /// Throws Error if the text has a NAME that is not allowed (is_given_name).
  static SubjectText parse(std::string_view text);
};

/// Renames a subject. Its options, or the bound of a built-in subject, stay at the end of the new name:
/// "new:KEY=VALUE", "new@0.5". If `name` is "", the subject is returned unchanged.
std::unique_ptr<Subject> named(std::unique_ptr<Subject> subject, const std::string& name, bool is_plugin);

/// The name that named() gave to a subject; "" if the subject was not renamed.
std::string given_name(const Subject& subject);

}  // namespace nearmiss
