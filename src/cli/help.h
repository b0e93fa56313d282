// How --help is laid out: descriptions wrapped beside their options.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace spectrad {

class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter();
    std::string make_option(const CLI::Option* option, bool positional) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_footer(const CLI::App* app) const override;
};

}  // namespace spectrad
