// The corpora, and mutants of them, through every parser; without coverage, so that any compiler will do.
#include "fuzz/targets.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

using namespace spectrad;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> corpus(std::string_view target) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(SPECTRAD_SOURCE) / "tests/fuzz/corpus" / target))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> inputs;
    for (const fs::path& path : files) {
        std::ifstream file(path, std::ios::binary);
        inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return inputs;
}

/// Bytes changed, cut out, doubled, or taken from another input.
std::string mutant(const std::vector<std::string>& inputs, std::mt19937& chance) {
    const auto below = [&](size_t n) { return n == 0 ? 0 : chance() % n; };
    std::string text = inputs[below(inputs.size())];
    for (size_t i = 0; i <= below(4); ++i) {
        const size_t at = below(text.size() + 1), length = below(std::min<size_t>(text.size() - at, 32) + 1);
        const std::string& other = inputs[below(inputs.size())];
        switch (below(6)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, text.substr(at, length));
                break;
            case 2:
                text.insert(at, other.substr(below(other.size()), below(64)));
                break;
            case 3:
                text.insert(at, 1, static_cast<char>(chance()));
                break;
            default:
                if (at < text.size())
                    text[at] = static_cast<char>(below(2) ? chance() : text[at] ^ (1 << below(8)));
        }
    }
    return text;
}

}  // namespace

TEST_CASE("every parser answers every input of its corpus, and mutants of them, with a value or one line") {
    const char* seconds = std::getenv("SPECTRAD_SECONDS");
    const double each = seconds ? std::atof(seconds) : 1;
    for (const fuzz::Target& target : fuzz::targets()) {
        const std::vector<std::string> inputs = corpus(target.name);
        REQUIRE(inputs.size() >= 3);
        for (const std::string& input : inputs)
            target.run(input);
        std::mt19937 chance(1);
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(each);
        size_t runs = 0;
        for (; std::chrono::steady_clock::now() < end; ++runs)
            REQUIRE_NOTHROW(target.run(mutant(inputs, chance)));
        CHECK(runs > 10);
    }
}
