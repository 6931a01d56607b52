#include "command_line.hpp"

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "scree/base/error.hpp"
#include "scree/config/suggest.hpp"

namespace scree {
namespace {

/// The subcommand that was asked for, down to the last one, or the program itself.
const CLI::App& active(const CLI::App& app) {
  for (const CLI::App* sub : app.get_subcommands()) return active(*sub);
  return app;
}

std::vector<std::string> subcommands_of(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    words.push_back(sub->get_name());
  }
  return words;
}

/// Everything that may stand where the user wrote something else: options and subcommands.
std::vector<std::string> words_of(const CLI::App& app) {
  std::vector<std::string> words = subcommands_of(app);
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_lnames().empty()) words.push_back("--" + option->get_lnames().front());
  }
  return words;
}

/// The words of the command that lead to `app`: "scree plugins show".
std::string full_name(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : full_name(*app.get_parent()) + " " + app.get_name();
}

Error usage_error(const CLI::App& app, const CLI::ParseError& problem) {
  const CLI::App& command = active(app);
  std::string sentence = problem.what();
  if (problem.get_name() == "RequiredError" && command.get_parent() == nullptr) {
    const std::vector<std::string> words = subcommands_of(command);
    sentence = "say what to do: " + list_of(words);
  }
  const std::vector<std::string> unexpected = app.remaining(true);
  if (!unexpected.empty()) {
    sentence = "'" + unexpected.front() + "' is not understood here";
    const std::string nearest = nearest_word(unexpected.front(), words_of(command));
    if (!nearest.empty()) sentence += "; did you mean '" + nearest + "'?";
  }
  return Error{ErrorKind::usage, sentence + "; see `" + full_name(command) + " --help`"};
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app{"Granular flows with non-smooth dynamics, as plugins.", "scree"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string{"scree "} + SCREE_VERSION);
  app.failure_message([](const CLI::App*, const CLI::Error&) { return std::string{}; });
  int exit_code = 0;
  add_run_command(app, exit_code);
  add_check_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_solve_command(app, exit_code);
  add_plugins_command(app, exit_code);
  add_decompose_command(app, exit_code);
  add_schema_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::ParseError& problem) {
    throw usage_error(app, problem);
  }
  return exit_code;
}

}  // namespace scree
