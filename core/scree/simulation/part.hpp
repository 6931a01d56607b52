// Part: a plugin that takes part in a simulation, with the name by which messages call it.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/config/options.hpp"

namespace scree {

/// Who a part is: for messages, checkpoints and random streams.
struct PartInfo {
  std::string kind;        ///< "force_field"
  std::string type;        ///< name of the plugin, "drag"
  std::string name;        ///< unique within its kind; the scene's `name`, else the type
  std::string library;     ///< file of the plugin
  std::string version;     ///< of that library
  SourceLocation where{};  ///< of its section in the scene

  /// "force_field:drag", or "force_field:drag 'upper'" when the scene gave it a name.
  [[nodiscard]] std::string label() const {
    return kind + ":" + type + (name == type ? std::string{} : " '" + name + "'");
  }
  /// "force_field:drag (drag.so)".
  [[nodiscard]] std::string label_with_library() const {
    return label() + " (" + library.substr(library.find_last_of('/') + 1) + ")";
  }
};

/// A plugin in a simulation, with the options it was made from.
template <class Interface>
struct Part {
  PartInfo info;
  Options options;
  Options core;  ///< what core itself reads of the section, such as `name`
  std::unique_ptr<Interface> plugin;
};

/// Calls into a plugin. What escapes, other than an Error, is reported with the plugin's name.
template <class Call>
decltype(auto) guarded(const PartInfo& who, ErrorKind kind, Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error{kind, who.label_with_library() + ": " + problem.what()};
  } catch (...) {
    throw Error{kind, who.label_with_library() + ": threw something that is no std::exception"};
  }
}

}  // namespace scree
