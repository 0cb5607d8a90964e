//! Tokens → syntax tree, by precedence climbing. Names are resolved on the way.

use crate::error::{ErrorKind, FormulaError, TextSpan, nearest};
use crate::language::ast::{Ast, Expr, ExprId, ExprKind, Infix, Prefix, precedence};
use crate::language::lexer::{Token, TokenKind, tokens};
use crate::language::scope::{NameMeaning, Scope};
use crate::library::{self, LibraryFunction};
use crate::limits::{MAX_DEPTH, MAX_LENGTH};
use crate::operation::Binary;
use crate::spelling;

/// Parses a formula whose names are those of `scope`.
pub(crate) fn parse(source: &str, scope: &Scope) -> Result<Ast, FormulaError> {
    if source.len() > MAX_LENGTH {
        return Err(FormulaError::new(source, TextSpan { start: 0, end: 0 }, ErrorKind::TooLong));
    }
    let tokens = tokens(source)?;
    let mut parser =
        Parser { source, scope, tokens, next: 0, nodes: Vec::new(), locals: Vec::new(), depth: 0 };
    let root = parser.block()?;
    parser.expect(TokenKind::End, "an operator or the end")?;
    Ok(Ast { nodes: parser.nodes, root })
}

struct Parser<'a> {
    source: &'a str,
    scope: &'a Scope,
    tokens: Vec<Token>,
    next: usize,
    nodes: Vec<Expr>,
    /// Names bound by `let`, innermost last; `None` while the value is being read.
    locals: Vec<(&'a str, Option<ExprId>)>,
    depth: usize,
}

type ParseResult = Result<ExprId, FormulaError>;

impl<'a> Parser<'a> {
    /// `let name = expression; … expression`; what `let` binds holds to the end of the block.
    fn block(&mut self) -> ParseResult {
        let outer = self.locals.len();
        while self.accept(TokenKind::Let) {
            self.binding()?;
        }
        let value = self.expression(0)?;
        self.locals.truncate(outer);
        Ok(value)
    }

    /// `name = expression;` after `let`.
    fn binding(&mut self) -> Result<(), FormulaError> {
        let span = self.expect(TokenKind::Name, "a new name")?.span;
        let name = self.text(span);
        if library::is_reserved(name) || self.scope.meaning(name).is_some() || self.is_local(name) {
            return Err(self.error(span, ErrorKind::NameTaken));
        }
        self.expect(TokenKind::Assign, "`=`")?;
        self.locals.push((name, None));
        let value = self.expression(0)?;
        self.expect(TokenKind::Semicolon, "an operator or `;`")?;
        let last = self.locals.len() - 1;
        self.locals[last].1 = Some(value);
        Ok(())
    }

    /// Operands joined by operators that bind at least as tightly as `weakest`.
    fn expression(&mut self, weakest: u8) -> ParseResult {
        let mut left = self.operand()?;
        while let TokenKind::Operator(infix) = self.peek().kind {
            let strength = precedence::of(infix);
            if strength < weakest {
                break;
            }
            self.advance();
            let right = if infix == Infix::Arithmetic(Binary::Pow) {
                self.nested(|p| p.expression(strength))?
            } else {
                self.expression(strength + 1)?
            };
            let span = self.span(left).to(self.span(right));
            left = self.push(ExprKind::Infix(infix, left, right), span);
            if infix.is_comparison() {
                self.refuse_comparison()?;
            }
        }
        Ok(left)
    }

    fn refuse_comparison(&self) -> Result<(), FormulaError> {
        match self.peek().kind {
            TokenKind::Operator(next) if next.is_comparison() => {
                Err(self.error(self.peek().span, ErrorKind::ChainedComparison))
            }
            _ => Ok(()),
        }
    }

    /// An atom, or an operand with its sign.
    fn operand(&mut self) -> ParseResult {
        let token = self.peek();
        let (prefix, strength) = match token.kind {
            TokenKind::Operator(Infix::Arithmetic(Binary::Sub)) => {
                (Prefix::Minus, precedence::POWER)
            }
            TokenKind::Operator(Infix::Arithmetic(Binary::Add)) => {
                (Prefix::Plus, precedence::POWER)
            }
            TokenKind::Not => (Prefix::Not, precedence::COMPARISON),
            _ => return self.atom(),
        };
        self.advance();
        let operand = self.nested(|p| p.expression(strength))?;
        let span = token.span.to(self.span(operand));
        Ok(self.push(ExprKind::Prefix(prefix, operand), span))
    }

    /// A number, a name, a call or a block in parentheses.
    fn atom(&mut self) -> ParseResult {
        let token = self.peek();
        match token.kind {
            TokenKind::Number(value) => {
                self.advance();
                Ok(self.push(ExprKind::Number(value), token.span))
            }
            TokenKind::Name => {
                self.advance();
                if self.peek().kind == TokenKind::Open {
                    self.call(token.span)
                } else {
                    self.name(token.span)
                }
            }
            TokenKind::Open => {
                self.advance();
                let inner = self.nested(Self::block)?;
                self.expect(TokenKind::Close, "an operator or `)`")?;
                Ok(inner)
            }
            _ => {
                let expected = "a number, a name or `(`";
                Err(self.error(token.span, ErrorKind::Unexpected { expected }))
            }
        }
    }

    fn name(&mut self, span: TextSpan) -> ParseResult {
        let name = self.text(span);
        if let Some(&(_, value)) = self.locals.iter().rev().find(|(local, _)| *local == name) {
            return value.ok_or_else(|| self.error(span, ErrorKind::SelfReference));
        }
        let kind = match (self.scope.meaning(name), library::constant(name)) {
            (Some(NameMeaning::Input(index)), _) => ExprKind::Input(index),
            (Some(NameMeaning::Table(_)), _) => {
                return Err(self.error(span, ErrorKind::TableForNumber));
            }
            (Some(NameMeaning::Value(value)), _) | (None, Some(value)) => ExprKind::Number(value),
            (None, None) => return Err(self.error(span, self.unknown_name(name))),
        };
        Ok(self.push(kind, span))
    }

    /// The arguments of the function whose name stands at `name`.
    fn call(&mut self, name: TextSpan) -> ParseResult {
        let function = self.function(name)?;
        self.expect(TokenKind::Open, "`(`")?;
        let Some(expected) = function.arity() else {
            return match function {
                LibraryFunction::Side => self.side(name),
                _ => self.table(name, function == LibraryFunction::TableDerivative),
            };
        };
        let mut arguments = Vec::new();
        if self.peek().kind != TokenKind::Close {
            arguments.push(self.nested(Self::block)?);
            arguments.extend(self.further_arguments()?);
        }
        let close = self.expect(TokenKind::Close, "an operator, `,` or `)`")?;
        let given = arguments.len();
        if given != expected {
            let suggestion = self.with_arguments(name, given);
            return Err(self.error(name, ErrorKind::ArgumentCount { expected, given, suggestion }));
        }
        Ok(self.push(ExprKind::Call(function, arguments), name.to(close.span)))
    }

    /// Arguments, each after a comma.
    fn further_arguments(&mut self) -> Result<Vec<ExprId>, FormulaError> {
        let mut arguments = Vec::new();
        while self.accept(TokenKind::Comma) {
            arguments.push(self.nested(Self::block)?);
        }
        Ok(arguments)
    }

    /// `name, x)`, `name, x, y)` or, of a derivative, `name, m, x)`, `name, m, n, x, y)` after the
    /// parenthesis of `table(`; its name stands at `function`.
    fn table(&mut self, function: TextSpan, derivative: bool) -> ParseResult {
        let name = self.expect(TokenKind::Name, "the name of a table")?.span;
        let table = self.table_named(name)?;
        let n = self.scope.tables()[table as usize].n_arguments();
        let arguments = self.further_arguments()?;
        let close = self.expect(TokenKind::Close, "an operator, `,` or `)`")?;
        let expected = if derivative { 2 * n } else { n };
        if arguments.len() != expected {
            let given = arguments.len() + 1;
            let form = table_form(self.text(name), n, derivative).into();
            return Err(self.error(function, ErrorKind::TableArguments { form, given }));
        }
        let mut orders = [0; 2];
        for (order, &argument) in orders.iter_mut().zip(&arguments[..expected - n]) {
            *order = self.order(argument)?;
        }
        let (x, y) = (arguments[expected - n], arguments.get(expected - n + 1).copied());
        Ok(self.push(ExprKind::Table { table, orders, x, y }, function.to(close.span)))
    }

    /// `k)` after the parenthesis of `side(`; its name stands at `function`.
    fn side(&mut self, function: TextSpan) -> ParseResult {
        let cracks = self.scope.n_sides();
        if cracks == 0 {
            return Err(self.error(function, ErrorKind::NoCracks));
        }
        if self.peek().kind == TokenKind::Close {
            let expected = "the number of a crack";
            return Err(self.error(self.peek().span, ErrorKind::Unexpected { expected }));
        }
        let argument = self.nested(Self::block)?;
        let close = self.expect(TokenKind::Close, "an operator or `)`")?;
        let input = match self.nodes[argument.index()].kind {
            ExprKind::Number(k) => self.scope.input(&format!("side({k})")),
            _ => None,
        };
        match input {
            Some(input) => Ok(self.push(ExprKind::Input(input), function.to(close.span))),
            None => Err(self.error(self.span(argument), ErrorKind::UnknownCrack { cracks })),
        }
    }

    fn table_named(&self, span: TextSpan) -> Result<u32, FormulaError> {
        let name = self.text(span);
        if let Some(NameMeaning::Table(table)) = self.scope.meaning(name) {
            return Ok(table);
        }
        let names: Vec<&str> = self.scope.table_names().collect();
        let mistake = if names.is_empty() {
            ErrorKind::NoTables
        } else {
            let suggestion = nearest(name, names.iter().copied()).map(String::into_boxed_str);
            ErrorKind::UnknownTable { suggestion, known: names.join(", ").into() }
        };
        Err(self.error(span, mistake))
    }

    /// The order of a derivative; beyond the third they are 0, but may be asked for.
    fn order(&self, argument: ExprId) -> Result<u8, FormulaError> {
        match self.nodes[argument.index()].kind {
            ExprKind::Number(order) if (0.0..=9.0).contains(&order) && order.fract() == 0.0 => {
                Ok(order as u8)
            }
            _ => Err(self.error(self.span(argument), ErrorKind::InvalidOrder)),
        }
    }

    fn function(&self, span: TextSpan) -> Result<LibraryFunction, FormulaError> {
        let name = self.text(span);
        let mistake = match LibraryFunction::named(name) {
            Some(function) => return Ok(function),
            None if self.scope.table_names().any(|known| known == name) => {
                ErrorKind::TableForNumber
            }
            None if self.known_names().any(|known| known == name) => ErrorKind::NotAFunction,
            None => {
                let names = library::function_names();
                let foreign = library::foreign(name).map(str::to_owned);
                ErrorKind::UnknownFunction { suggestion: foreign.or_else(|| nearest(name, names)) }
            }
        };
        Err(self.error(span, mistake))
    }

    /// The function of a similar name that takes this many arguments.
    fn with_arguments(&self, name: TextSpan, given: usize) -> Option<&'static str> {
        let fits = |function: LibraryFunction| function.arity() == Some(given);
        let fitting = library::functions().filter(|(_, function)| fits(*function));
        spelling::nearest(self.text(name), fitting.map(|(known, _)| known))
    }

    fn unknown_name(&self, name: &str) -> ErrorKind {
        if LibraryFunction::named(name).is_some() {
            return ErrorKind::MissingArguments;
        }
        if self.peek().kind == TokenKind::Assign {
            return ErrorKind::MissingLet;
        }
        let table =
            || nearest(name, self.scope.table_names()).map(|name| format!("table({name}, …)"));
        ErrorKind::UnknownName { suggestion: nearest(name, self.known_names()).or_else(table) }
    }

    /// Every name that stands for a value here.
    fn known_names(&self) -> impl Iterator<Item = &str> {
        let locals = self.locals.iter().map(|&(name, _)| name);
        let constants = library::CONSTANTS.iter().map(|&(name, _)| name);
        // `cos(theta/2)` and `side(0)` are no names
        let names = self.scope.names().filter(|name| !name.contains('('));
        names.chain(locals).chain(constants)
    }

    fn is_local(&self, name: &str) -> bool {
        self.locals.iter().any(|(local, _)| *local == name)
    }

    /// Goes one level deeper. Every recursion of the grammar passes here, or through the few
    /// levels of precedence.
    fn nested(&mut self, inner: impl FnOnce(&mut Self) -> ParseResult) -> ParseResult {
        if self.depth == MAX_DEPTH {
            return Err(self.error(self.peek().span, ErrorKind::TooDeep));
        }
        self.depth += 1;
        let value = inner(self)?;
        self.depth -= 1;
        Ok(value)
    }

    fn push(&mut self, kind: ExprKind, span: TextSpan) -> ExprId {
        let id = u32::try_from(self.nodes.len()).expect("fewer nodes than MAX_LENGTH");
        self.nodes.push(Expr { kind, span });
        ExprId(id)
    }

    fn span(&self, id: ExprId) -> TextSpan {
        self.nodes[id.index()].span
    }

    fn text(&self, span: TextSpan) -> &'a str {
        &self.source[span.range()]
    }

    fn peek(&self) -> Token {
        self.tokens[self.next]
    }

    /// Passes a token; the end stays.
    fn advance(&mut self) {
        self.next = (self.next + 1).min(self.tokens.len() - 1);
    }

    fn accept(&mut self, kind: TokenKind) -> bool {
        let fits = self.peek().kind == kind;
        if fits {
            self.advance();
        }
        fits
    }

    fn expect(&mut self, kind: TokenKind, expected: &'static str) -> Result<Token, FormulaError> {
        let token = self.peek();
        if !self.accept(kind) {
            let compares = token.kind == TokenKind::Assign && expected.starts_with("an operator");
            let expected = if compares { "`==` to compare" } else { expected };
            return Err(self.error(token.span, ErrorKind::Unexpected { expected }));
        }
        Ok(token)
    }

    fn error(&self, span: TextSpan, mistake: ErrorKind) -> FormulaError {
        FormulaError::new(self.source, span, mistake)
    }
}

/// The form of a table of `n` arguments.
fn table_form(name: &str, n: usize, derivative: bool) -> String {
    let arguments = if n == 1 { "x" } else { "x, y" };
    match (derivative, n) {
        (false, _) => format!("table({name}, {arguments})"),
        (true, 1) => format!("dtable({name}, m, {arguments})"),
        (true, _) => format!("dtable({name}, m, n, {arguments})"),
    }
}
