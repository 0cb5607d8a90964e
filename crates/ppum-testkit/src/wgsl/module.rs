//! Modules, and calls of their functions.

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::interpreter::CallFrame;
use super::value::WgslValue;

/// A valid module.
#[derive(Debug)]
pub struct Module {
    naga: naga::Module,
}

impl Module {
    /// Parses and validates a text.
    ///
    /// # Errors
    /// When it is no valid WGSL: the message of naga, with the place.
    pub fn new(source: &str) -> Result<Self, String> {
        let naga =
            naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::default());
        validator.validate(&naga).map_err(|error| error.emit_to_string(source))?;
        Ok(Self { naga })
    }

    /// Names of its functions.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        self.naga.functions.iter().filter_map(|(_, function)| function.name.as_deref())
    }

    /// The numbers that a function of numbers gives: one, or those of an array.
    ///
    /// # Errors
    /// When there is no such function, it has other parameters, or it uses what this interpreter
    /// does not know.
    pub fn call(&self, function: &str, arguments: &[f32]) -> Result<Vec<f32>, String> {
        let found = self.naga.functions.iter().find(|(_, f)| f.name.as_deref() == Some(function));
        let (_, found) = found.ok_or_else(|| format!("no function `{function}`"))?;
        let arguments: Vec<WgslValue> = arguments.iter().map(|&a| WgslValue::F32(a)).collect();
        let result = CallFrame::call(&self.naga, found, arguments);
        result.and_then(|value| value.numbers()).map_err(|error| format!("`{function}`: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(source: &str, arguments: &[f32]) -> Result<Vec<f32>, String> {
        Module::new(source)?.call("f", arguments)
    }

    #[test]
    fn loops_branches_and_calls() {
        let source = "
            fn square(x: f32) -> f32 { return x * x; }
            fn f(x: f32) -> array<f32, 2> {
                var n = 0u;
                var sum = 0.0;
                loop {
                    if n == 5u { break; }
                    if n % 2u == 1u { n = n + 1u; continue; }
                    sum += square(x);
                    continuing { n += 1u; }
                }
                return array<f32, 2>(sum, f32(n));
            }";
        // n = 0; 1 skips to 3, 3 to 5
        assert_eq!(call(source, &[3.0]), Ok(vec![9.0, 5.0]));
    }

    #[test]
    fn constants_and_indices() {
        let source = "
            const a = array<vec4<f32>, 2>(vec4(1.0, 2.0, 3.0, 4.0), vec4(5.0, 6.0, 7.0, 8.0));
            fn f(x: f32) -> f32 { return a[u32(x)].z; }";
        assert_eq!(call(source, &[1.0]), Ok(vec![7.0]));
        assert!(call(source, &[2.0]).is_err_and(|error| error.contains("index 2")));
    }

    #[test]
    fn vectors_and_structures() {
        let source = "
            struct Pair { a: vec2<f32>, b: array<f32, 2> }
            fn swapped(p: Pair) -> Pair {
                var q = Pair();
                q.a = p.a.yx * 2.0 - vec2(1.0);
                for (var k = 0u; k < 2u; k++) { q.b[k] = p.b[1u - k]; }
                q.a.x += dot(p.a, p.a);
                return q;
            }
            fn f(x: f32, y: f32) -> array<f32, 5> {
                let p = swapped(Pair(vec2(x, y), array<f32, 2>(5.0, 6.0)));
                let larger = select(p.a, vec2(7.0), p.a > vec2(10.0));
                let bits = bitcast<vec2<f32>>(bitcast<vec2<u32>>(p.a));
                return array<f32, 5>(larger.x, larger.y, bits.y, p.b[0], p.b[1]);
            }";
        // 2·4 − 1 + 25 = 32 > 10, and 2·3 − 1 = 5
        assert_eq!(call(source, &[3.0, 4.0]), Ok(vec![7.0, 5.0, 5.0, 6.0, 5.0]));
    }

    #[test]
    fn single_precision() {
        let source = "fn f(x: f32) -> f32 { return (x + 1.0) - 1.0; }";
        assert_eq!(call(source, &[f32::EPSILON / 4.0]), Ok(vec![0.0]));
        assert_eq!(call("fn f(x: f32) -> f32 { return exp(x); }", &[1.0]), Ok(vec![1f32.exp()]));
    }

    #[test]
    fn what_wgsl_leaves_open_is_nan() {
        for body in ["pow(x, 2.0)", "atan2(x + 1.0, 0.0)", "sqrt(x)", "acos(x - 1.0)"] {
            let source = format!("fn f(x: f32) -> f32 {{ return {body}; }}");
            assert!(call(&source, &[-1.0]).is_ok_and(|result| result[0].is_nan()), "{body}");
        }
    }

    #[test]
    fn errors_name_what_is_wrong() {
        assert!(Module::new("fn f() -> f32 { return 1.0 }").is_err());
        assert!(Module::new("fn f() -> f32 { return 1u; }").is_err());
        assert!(
            call("fn f(x: f32) -> f32 { return fract(x); }", &[1.0])
                .is_err_and(|error| error.contains("Fract"))
        );
        assert!(call("fn g() {}", &[]).is_err_and(|error| error.contains("no function `f`")));
        assert!(call("fn f(x: f32) -> f32 { return x; }", &[]).is_err());
    }
}
