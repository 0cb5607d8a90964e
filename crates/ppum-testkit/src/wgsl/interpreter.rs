//! The walk over naga's representation of a function.

use naga::{
    Arena, ArraySize, Block, Expression, Function, Handle, Module, Statement, Type, TypeInner,
};

use super::value::{WgslValue, binary, math, unary, unknown};

/// One call of a function.
pub(super) struct CallFrame<'m> {
    module: &'m Module,
    function: &'m Function,
    arguments: Vec<WgslValue>,
    variables: Vec<Option<WgslValue>>,
    /// Results of the expressions that were emitted.
    results: Vec<Option<WgslValue>>,
}

/// The next step of execution after a statement.
enum Flow {
    On,
    Break,
    Continue,
    Return(Option<WgslValue>),
}

impl<'m> CallFrame<'m> {
    /// The result of a function.
    pub(super) fn call(
        module: &'m Module,
        function: &'m Function,
        arguments: Vec<WgslValue>,
    ) -> Result<WgslValue, String> {
        let (given, expected) = (arguments.len(), function.arguments.len());
        if given != expected {
            return Err(format!("{given} arguments, not {expected}"));
        }
        let variables = vec![None; function.local_variables.len()];
        let results = vec![None; function.expressions.len()];
        let mut frame = Self { module, function, arguments, variables, results };
        frame.initialize()?;
        match frame.block(&function.body)? {
            Flow::Return(Some(value)) => Ok(value),
            _ => Err("no result".to_owned()),
        }
    }

    fn initialize(&mut self) -> Result<(), String> {
        for (handle, variable) in self.function.local_variables.iter() {
            self.variables[handle.index()] = match variable.init {
                Some(init) => Some(self.value(init)?),
                None => zero(self.module, variable.ty).ok(),
            };
        }
        Ok(())
    }

    fn block(&mut self, block: &'m Block) -> Result<Flow, String> {
        for statement in block.iter() {
            match self.statement(statement)? {
                Flow::On => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::On)
    }

    fn statement(&mut self, statement: &'m Statement) -> Result<Flow, String> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    self.results[handle.index()] = Some(self.evaluate(handle)?);
                }
            }
            Statement::Block(block) => return self.block(block),
            Statement::If { condition, accept, reject } => {
                let holds = self.value(*condition)?.holds()?;
                return self.block(if holds { accept } else { reject });
            }
            Statement::Loop { body, continuing, break_if } => {
                return self.repeat(body, continuing, *break_if);
            }
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                return Ok(Flow::Return(value.map(|value| self.value(value)).transpose()?));
            }
            Statement::Store { pointer, value } => {
                let WgslValue::Pointer(variable, path) = self.value(*pointer)? else {
                    return unknown(statement);
                };
                let value = self.value(*value)?;
                match (&mut self.variables[variable.index()], &path[..]) {
                    (whole, []) => *whole = Some(value),
                    (Some(whole), path) => *whole.part(path)? = value,
                    (None, _) => return Err("a part of a variable without a value".to_owned()),
                }
            }
            Statement::Call { function, arguments, result: Some(result) } => {
                let arguments: Result<_, _> = arguments.iter().map(|&a| self.value(a)).collect();
                let function = &self.module.functions[*function];
                self.results[result.index()] = Some(Self::call(self.module, function, arguments?)?);
            }
            other => return unknown(other),
        }
        Ok(Flow::On)
    }

    fn repeat(
        &mut self,
        body: &'m Block,
        continuing: &'m Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<Flow, String> {
        loop {
            match self.block(body)? {
                Flow::On | Flow::Continue => {}
                Flow::Break => return Ok(Flow::On),
                done @ Flow::Return(_) => return Ok(done),
            }
            self.block(continuing)?;
            if let Some(condition) = break_if
                && self.value(condition)?.holds()?
            {
                return Ok(Flow::On);
            }
        }
    }

    /// The value that an expression has given, or gives whenever it is asked.
    fn value(&self, handle: Handle<Expression>) -> Result<WgslValue, String> {
        match &self.results[handle.index()] {
            Some(value) => Ok(value.clone()),
            None => self.evaluate(handle),
        }
    }

    fn evaluate(&self, handle: Handle<Expression>) -> Result<WgslValue, String> {
        let at = |handle: Handle<Expression>| self.value(handle);
        match &self.function.expressions[handle] {
            Expression::FunctionArgument(index) => Ok(self.arguments[*index as usize].clone()),
            Expression::LocalVariable(variable) => Ok(WgslValue::Pointer(*variable, vec![])),
            Expression::Load { pointer } => match at(*pointer)? {
                WgslValue::Pointer(variable, path) => {
                    let whole = self.variables[variable.index()]
                        .as_ref()
                        .ok_or("a variable is read before it is written")?;
                    path.iter().try_fold(whole.clone(), |value, &index| value.element(index))
                }
                other => unknown(other),
            },
            Expression::Access { base, index } => self.element(*base, at(*index)?.index()?),
            Expression::AccessIndex { base, index } => self.element(*base, *index as usize),
            Expression::Unary { op, expr } => unary(*op, &at(*expr)?),
            Expression::Binary { op, left, right } => binary(*op, &at(*left)?, &at(*right)?),
            Expression::Select { condition, accept, reject } => {
                at(*condition)?.select(&at(*accept)?, &at(*reject)?)
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let arguments = [Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten();
                math(*fun, &arguments.map(at).collect::<Result<Vec<_>, _>>()?)
            }
            Expression::As { expr, kind, convert } => at(*expr)?.cast(*kind, *convert),
            _ => constant(self.module, &self.function.expressions, handle, &at),
        }
    }

    /// An element, without a copy of what it is an element of.
    fn element(&self, base: Handle<Expression>, index: usize) -> Result<WgslValue, String> {
        match &self.results[base.index()] {
            Some(value) => value.element(index),
            None => self.evaluate(base)?.element(index),
        }
    }
}

/// The expressions that may be constant; `at` gives the value of another one of the arena.
fn constant(
    module: &Module,
    arena: &Arena<Expression>,
    handle: Handle<Expression>,
    at: &dyn Fn(Handle<Expression>) -> Result<WgslValue, String>,
) -> Result<WgslValue, String> {
    match &arena[handle] {
        Expression::Literal(literal) => WgslValue::literal(*literal),
        Expression::Constant(constant) => global(module, module.constants[*constant].init),
        Expression::ZeroValue(ty) => zero(module, *ty),
        Expression::Splat { size, value } => Ok(WgslValue::List(vec![at(*value)?; *size as usize])),
        Expression::Swizzle { size, vector, pattern } => {
            let vector = at(*vector)?;
            let picked = pattern[..*size as usize].iter().map(|&c| vector.element(c as usize));
            picked.collect::<Result<_, _>>().map(WgslValue::List)
        }
        Expression::Compose { ty, components } => {
            let parts: Vec<WgslValue> =
                components.iter().map(|&c| at(c)).collect::<Result<_, _>>()?;
            match module.types[*ty].inner {
                TypeInner::Array { .. } | TypeInner::Struct { .. } => Ok(WgslValue::List(parts)),
                // of numbers and shorter vectors
                TypeInner::Vector { .. } => {
                    Ok(WgslValue::List(parts.into_iter().flat_map(WgslValue::elements).collect()))
                }
                ref other => unknown(other),
            }
        }
        other => unknown(other),
    }
}

/// A constant of the module.
fn global(module: &Module, handle: Handle<Expression>) -> Result<WgslValue, String> {
    constant(module, &module.global_expressions, handle, &|handle| global(module, handle))
}

/// The zero of a type.
fn zero(module: &Module, ty: Handle<Type>) -> Result<WgslValue, String> {
    match module.types[ty].inner {
        TypeInner::Scalar(scalar) => WgslValue::zero(scalar.kind),
        TypeInner::Vector { size, scalar } => {
            Ok(WgslValue::List(vec![WgslValue::zero(scalar.kind)?; size as usize]))
        }
        TypeInner::Array { base, size: ArraySize::Constant(size), .. } => {
            Ok(WgslValue::List(vec![zero(module, base)?; size.get() as usize]))
        }
        TypeInner::Struct { ref members, .. } => {
            let zeros = members.iter().map(|member| zero(module, member.ty));
            zeros.collect::<Result<_, _>>().map(WgslValue::List)
        }
        ref other => unknown(other),
    }
}
