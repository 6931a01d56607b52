// The subcommands of `scree`. Each lives in a file of its own.
#pragma once

namespace CLI {
class App;
}

namespace scree {

/// Adds a subcommand with its options to `app`. When the command line asks for it, it runs and leaves its exit code.
/// What goes wrong leaves as Error. @{
void add_run_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_plugins_command(CLI::App& app, int& exit_code);
void add_compare_command(CLI::App& app, int& exit_code);
void add_solve_command(CLI::App& app, int& exit_code);
void add_decompose_command(CLI::App& app, int& exit_code);
void add_schema_command(CLI::App& app, int& exit_code);
/// @}

}  // namespace scree
