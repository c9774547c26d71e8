//! Random filters of whole numbers: all statements of WGSL, pointers, calls, and operands at the ends of their ranges.
//! What they compute is known to the bit on every device.

use crate::random::Random;

/// A filter whose colour is a hash of all that its statements did.
pub fn filter(random: &mut Random) -> String {
    let mut writer = Writer { random, names: 0, loops: 0, switches: 0, result: "i" };
    let helper = writer.block(2, 4);
    writer.result = "vec3f(f32(u & 0xffffu), f32(u >> 16u), 1.0)";
    let body = writer.block(3, 6);
    format!(
        "struct All {{ i: i32, u: u32, a: array<i32, 4>, v: vec3i }}
fn helper(i0: i32, u0: u32, a0: ptr<function, array<i32, 4>>, o0: ptr<function, All>) -> i32 {{
var i = i0; var u = u0; var h = 1; var a = *a0; var v = (*o0).v; var o = *o0;
{helper}*a0 = a; *o0 = o; (*o0).v = v.zxy; (*o0).a[u] += h;
return i ^ h;
}}
fn filter_color(c: vec3f, s: Surface) -> vec3f {{
var i = i32(s.pixel.x) * 1000 - 2500; var u = u32(s.pixel.y); var h = 0;
var a = array(i32(c.x * 4096.0), i32(c.y * 4096.0) - 2048, -2147483647 - i32(u), 7);
var v = vec3i(a[0], i, a[1]); var o = All(i, u, a, v);
{body}i += helper(i, u, &a, &o);
u ^= bitcast<u32>((h * 31) ^ i);
for (var k = 0u; k < 4u; k++) {{ u = u * 1664525u + bitcast<u32>(a[k] ^ o.a[k]); }}
u ^= bitcast<u32>(v.x + 3 * v.y - 5 * v.z) ^ bitcast<u32>(o.i ^ o.v.y) ^ (o.u * 77u);
return vec3f(f32(u & 0xffffu), f32(u >> 16u), 0.0);
}}
"
    )
}

/// Writes what may stand in a function with `var`s `i`, `u`, `h`, `a`, `v` and `o`.
struct Writer<'r> {
    random: &'r mut Random,
    /// How many loop variables have a name.
    names: usize,
    /// Loops and switches around the next statement.
    loops: usize,
    switches: usize,
    /// What `return` gives.
    result: &'static str,
}

impl Writer<'_> {
    fn one_of(&mut self, choices: &[&str]) -> String {
        choices[self.random.index(choices.len())].to_owned()
    }

    /// Up to so many statements, with blocks in them to a depth.
    fn block(&mut self, depth: usize, most: usize) -> String {
        let count = 1 + self.random.index(most);
        (0..count).map(|_| self.statement(depth) + "\n").collect()
    }

    fn inner(&mut self, depth: usize) -> String {
        self.block(depth - 1, 3)
    }

    fn in_loop(&mut self, depth: usize) -> String {
        self.loops += 1;
        let block = self.inner(depth);
        self.loops -= 1;
        block
    }

    fn in_switch(&mut self, depth: usize) -> String {
        self.switches += 1;
        let block = self.inner(depth);
        self.switches -= 1;
        block
    }

    fn statement(&mut self, depth: usize) -> String {
        match self.random.index(if depth == 0 { 10 } else { 17 }) {
            0 => format!("i = {};", self.signed(3)),
            1 => format!("u = {};", self.unsigned(3)),
            2 => format!("a[{}] {} {};", self.index(), self.one_of(&["=", "+=", "*=", "^=", "|="]), self.signed(2)),
            3 => format!("v[{}] = {};", self.index(), self.signed(2)),
            4 => format!("v = vec3i({}, v.x, {}) - v.zxy;", self.signed(2), self.signed(1)),
            5 => format!("o.a[{}] -= {}; o.u += {};", self.index(), self.signed(1), self.unsigned(1)),
            6 => format!("{{ let p = &a[{}]; *p += {}; o.i ^= *p; }}", self.index(), self.signed(2)),
            7 => {
                let leave = match (self.loops, self.switches) {
                    (0, 0) => format!("return {};", self.result),
                    (0, _) => "break;".to_owned(),
                    _ => self.one_of(&["break;", "continue;"]),
                };
                format!("if {} {{ {leave} }}", self.boolean(2))
            }
            8 | 9 => format!("h = h * 31 + {};", self.signed(2)),
            10 => format!("if {} {{\n{}}}", self.boolean(2), self.inner(depth)),
            11 => {
                let conditions = [self.boolean(2), self.boolean(1)];
                let blocks = [self.inner(depth), self.inner(depth), self.inner(depth)];
                let [first, second] = conditions;
                let [a, b, c] = blocks;
                format!("if {first} {{\n{a}}} else if {second} {{\n{b}}} else {{\n{c}}}")
            }
            12 => {
                self.names += 1;
                let k = format!("k{}", self.names);
                let (bound, block) = (self.signed(1), self.in_loop(depth));
                format!("for (var {k} = 0; {k} < ({bound} & 3); {k}++) {{\nh += {k};\n{block}}}")
            }
            13 => {
                let (condition, block) = (self.boolean(1), self.in_loop(depth));
                format!("while (u & 7u) != 3u && {condition} {{\nu += 1u;\n{block}}}")
            }
            14 => {
                let (block, condition) = (self.in_loop(depth), self.boolean(1));
                format!(
                    "loop {{\nvar fresh: i32; fresh += 1; h += fresh;\n{block}continuing {{ o.u += 1u; break if o.u % 4u == 0u || {condition}; }} }}"
                )
            }
            15 => {
                let (of, last) = if self.random.chance(0.5) {
                    (format!("{} & 3", self.signed(1)), "-2147483648")
                } else {
                    (self.one_of(&["i", "v.x", "a[1] % 3"]), "-1")
                };
                let [a, b, c] = [(); 3].map(|()| self.in_switch(depth));
                format!(
                    "switch {of} {{ case 0, 2: {{\n{a}}} case {last}: {{ i += 1; }} case 1: {{\n{b}}} case 3, default: {{\n{c}}} }}"
                )
            }
            _ => format!("{{ var i = {};\n{}h ^= i; }}", self.signed(2), self.inner(depth)),
        }
    }

    /// In range or not.
    fn index(&mut self) -> String {
        self.one_of(&["0", "1", "2", "i", "u", "u % 4u", "i & 3", "v.x"])
    }

    /// An i32 that is known at run time only.
    fn signed(&mut self, depth: usize) -> String {
        if depth == 0 {
            return self.one_of(&["i", "h", "a[0]", "a[3]", "v.y", "v.z", "o.i", "o.a[2]", "o.v.x"]);
        }
        let d = depth - 1;
        let a = self.signed(d);
        match self.random.index(16) {
            0 | 1 => {
                let right = self.one_of(&["1", "-1", "7", "2147483647", "-2147483648", "1000"]);
                format!("({a} {} {right})", self.one_of(&["+", "-", "*", "/", "%", "&", "|", "^"]))
            }
            2..=5 => format!("({a} {} {})", self.one_of(&["+", "-", "*", "/", "%", "&", "|", "^"]), self.signed(d)),
            6 => format!("({a} {} ({}))", self.one_of(&["<<", ">>"]), self.unsigned(d)),
            7 => format!(
                "{}({a})",
                self.one_of(&["-", "~", "abs", "sign", "reverseBits", "firstLeadingBit", "countOneBits"])
            ),
            8 => format!("{}({a}, {})", self.one_of(&["min", "max"]), self.signed(d)),
            9 => format!("clamp({a}, -100, {})", self.one_of(&["50", "2147483647"])),
            10 => format!("select({a}, {}, {})", self.signed(d), self.boolean(d)),
            11 => format!("extractBits({a}, {}, {})", self.unsigned(d), self.unsigned(0)),
            12 => format!("insertBits({a}, {}, {}, 5u)", self.signed(0), self.unsigned(0)),
            13 => format!("dot(v, v.yzx + {a})"),
            14 => format!("{}({})", self.one_of(&["i32", "bitcast<i32>"]), self.unsigned(d)),
            _ => format!("a[{}]", self.index()),
        }
    }

    fn unsigned(&mut self, depth: usize) -> String {
        if depth == 0 {
            return self.one_of(&["u", "o.u", "u32(i)", "bitcast<u32>(h)"]);
        }
        let d = depth - 1;
        let a = self.unsigned(d);
        match self.random.index(9) {
            0 => format!(
                "({a} {} {})",
                self.one_of(&["+", "-", "*", "/", "%"]),
                self.one_of(&["1u", "3u", "4294967295u"])
            ),
            1..=3 => format!("({a} {} {})", self.one_of(&["+", "-", "*", "/", "%", "&", "|", "^"]), self.unsigned(d)),
            4 => format!("({a} {} {})", self.one_of(&["<<", ">>"]), self.one_of(&["1u", "31u", "u"])),
            5 => format!("{}({a})", self.one_of(&["~", "countLeadingZeros", "firstTrailingBit", "firstLeadingBit"])),
            6 => format!("u32({})", self.boolean(d)),
            7 => format!("extractBits({a}, {}, 9u)", self.unsigned(0)),
            _ => format!("bitcast<u32>({})", self.signed(d)),
        }
    }

    fn boolean(&mut self, depth: usize) -> String {
        let compare = |writer: &mut Self| writer.one_of(&["<", "<=", ">", ">=", "==", "!="]);
        let d = depth.saturating_sub(1);
        match self.random.index(if depth == 0 { 2 } else { 6 }) {
            0 => format!("({} {} {})", self.signed(d), compare(self), self.signed(d)),
            1 => format!("({} {} {})", self.unsigned(d), compare(self), self.unsigned(d)),
            2 => format!(
                "({} {} {})",
                self.boolean(d),
                self.one_of(&["&&", "||", "&", "|", "==", "!="]),
                self.boolean(d)
            ),
            3 => format!("!{}", self.boolean(d)),
            4 => format!("{}(v {} v.zxy * {})", self.one_of(&["all", "any"]), compare(self), self.signed(d)),
            _ => format!("bool({})", self.signed(d)),
        }
    }
}
