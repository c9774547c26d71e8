// Sets of lenses.

// Bit i of word w stands for the lens of rank 32 w + i; behind the last lens come the overlap rules.
struct Set {
    words: array<u32, WORDS>,
}
