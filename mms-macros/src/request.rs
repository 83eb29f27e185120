//! The words between the parentheses of `field!`.

use mms_codegen::selection::{Entry, Freeze, Selection, compiled_quantity};
use mms_spec::Form;
use mms_spec::own::Own;
use mms_spec::source;
use mms_spec::suggest::advice;
use mms_spec::twin::Twin;
use proc_macro2::{Ident, Span};
use syn::ext::IdentExt as _;
use syn::parse::{Parse, ParseStream};
use syn::token::Bracket;
use syn::{Error, Lit, LitStr, Result, Token, braced, bracketed};

/// The options after the path.
const OPTIONS: [&str; 6] = ["quantities", "set", "freeze", "rigid", "form", "name"];

/// A parsed call of the macro.
pub struct Request {
    /// The path of the field file.
    pub path: LitStr,
    /// The name of the module, if it is not the file's.
    pub name: Option<Ident>,
    /// The wanted parts of the field, without the quantities.
    selection: Selection,
    /// The names of the selected quantities; `None` selects all.
    quantities: Option<Vec<Ident>>,
    /// The allowed ways to compute.
    pub form: Form,
    /// The places of the entries of `set` and `freeze`.
    places: Places,
}

#[derive(Default)]
struct Places {
    set: Vec<Span>,
    freeze: Vec<Span>,
    frozen: Option<Span>,
}

impl Parse for Request {
    fn parse(input: ParseStream) -> Result<Self> {
        let mut request = Request {
            path: input.parse()?,
            name: None,
            selection: Selection::default(),
            quantities: None,
            form: Form::default(),
            places: Places::default(),
        };
        let mut seen = Vec::<String>::new();
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let option = input.call(Ident::parse_any)?;
            let word = option.to_string();
            if seen.contains(&word) {
                return Err(Error::new(option.span(), format!("`{word}` is given twice")));
            }
            request.option(&option, input)?;
            seen.push(word);
        }
        Ok(request)
    }
}

impl Request {
    /// The part of the selection that a message of the compiler refers to.
    pub fn entry(&self, span: source::Span) -> Option<Entry> {
        self.selection.entry(span)
    }

    /// The place of a part of the selection in the call.
    pub fn span(&self, entry: Entry) -> Span {
        let span = match entry {
            Entry::Set(position) => self.places.set.get(position).copied(),
            Entry::Freeze(position) => self.places.freeze.get(position).copied(),
            Entry::Frozen => self.places.frozen,
        };
        span.unwrap_or_else(|| self.path.span())
    }

    fn option(&mut self, option: &Ident, input: ParseStream) -> Result<()> {
        match option.to_string().as_str() {
            "quantities" => self.quantities(input),
            "set" => self.set(input),
            "freeze" => self.freeze(option, input),
            "rigid" => self.rigid(input),
            "form" => self.form(input),
            "name" => {
                input.parse::<Token![=]>()?;
                let name = input.parse().map_err(|error: Error| {
                    Error::new(error.span(), "expected the name of a module")
                })?;
                self.name = Some(name);
                Ok(())
            }
            other => {
                let advice = advice(other, OPTIONS, |all| format!("the options are {all}"));
                Err(Error::new(option.span(), format!("unknown option `{other}`; {advice}")))
            }
        }
    }

    /// `= [body_force, velocity]`
    fn quantities(&mut self, input: ParseStream) -> Result<()> {
        input.parse::<Token![=]>()?;
        self.quantities = Some(names(input, "quantity")?);
        Ok(())
    }

    /// The selection, for a field with these quantities of its own.
    ///
    /// # Errors
    /// A name is no quantity, or is listed twice. The error is at its place.
    pub fn selection(&self, own: &[Own]) -> Result<Selection> {
        let mut selection = self.selection.clone();
        let Some(names) = &self.quantities else { return Ok(selection) };
        let wanted = selection.quantities.get_or_insert_default();
        for name in names {
            let found = compiled_quantity(own, &text(name))
                .map_err(|message| Error::new(name.span(), message))?;
            if !wanted.insert(found) {
                let message = format!("`{}` is listed twice", found.name());
                return Err(Error::new(name.span(), message));
            }
        }
        Ok(selection)
    }

    /// `= { lambda = 0, mu = "young/3" }`
    fn set(&mut self, input: ParseStream) -> Result<()> {
        input.parse::<Token![=]>()?;
        let content;
        braced!(content in input);
        while !content.is_empty() {
            let name = content.call(Ident::parse_any).map_err(|error| {
                Error::new(error.span(), "expected the name of a parameter, as in `mu = 1`")
            })?;
            content.parse::<Token![=]>()?;
            let (value, span) = value(&content)?;
            self.places.set.push(name.span().join(span).unwrap_or(name.span()));
            self.selection.set.push((text(&name), value));
            if !content.is_empty() {
                content.parse::<Token![,]>()?;
            }
        }
        Ok(())
    }

    /// `= "fast"`
    fn form(&mut self, input: ParseStream) -> Result<()> {
        input.parse::<Token![=]>()?;
        let name: LitStr = input.parse().map_err(|error: Error| {
            Error::new(error.span(), "expected a form in quotes: \"stable\" or \"fast\"")
        })?;
        self.form =
            Form::from_name(&name.value()).map_err(|message| Error::new(name.span(), message))?;
        Ok(())
    }

    /// Nothing, or `= "translation = ..."`.
    fn rigid(&mut self, input: ParseStream) -> Result<()> {
        self.selection.twin = Twin::Standard;
        if input.peek(Token![=]) {
            input.parse::<Token![=]>()?;
            let keys: LitStr = input.parse().map_err(|error: Error| {
                Error::new(error.span(), "expected the keys of [rigid] in quotes")
            })?;
            self.selection.twin = Twin::Given(keys.value());
        }
        Ok(())
    }

    /// Nothing, or `= [lambda, mu]`.
    fn freeze(&mut self, option: &Ident, input: ParseStream) -> Result<()> {
        self.places.frozen = Some(option.span());
        self.selection.freeze = Freeze::Everything;
        if input.peek(Token![=]) {
            input.parse::<Token![=]>()?;
            let names = names(input, "parameter")?;
            self.places.freeze = names.iter().map(Ident::span).collect();
            self.selection.freeze = Freeze::Only(names.iter().map(text).collect());
        }
        Ok(())
    }
}

/// A bracketed list of at least one name.
fn names(input: ParseStream, what: &str) -> Result<Vec<Ident>> {
    let content;
    if !input.peek(Bracket) {
        return Err(input.error(format!("expected a list in brackets, `[{what}, ..]`")));
    }
    let brackets = bracketed!(content in input);
    if content.is_empty() {
        let message = format!("expected at least one {what}");
        return Err(Error::new(brackets.span.join(), message));
    }
    let mut names = Vec::new();
    while !content.is_empty() {
        names.push(content.call(Ident::parse_any).map_err(|error| {
            Error::new(error.span(), format!("expected the name of a {what}, without quotes"))
        })?);
        if !content.is_empty() {
            content.parse::<Token![,]>()?;
        }
    }
    Ok(names)
}

/// A name as in a field file.
fn text(name: &Ident) -> String {
    name.unraw().to_string()
}

/// A number, digit by digit, or a formula in quotes.
fn value(input: ParseStream) -> Result<(String, Span)> {
    let sign = input.parse::<Option<Token![-]>>()?;
    let minus = if sign.is_some() { "-" } else { "" };
    let refusal = |span| Error::new(span, "expected a number, or a formula in quotes");
    let literal: Lit = input.parse().map_err(|error| refusal(error.span()))?;
    let span = literal.span();
    let digits = match &literal {
        Lit::Int(number) if number.suffix().is_empty() => number.base10_digits().to_string(),
        Lit::Float(number) if number.suffix().is_empty() => number.base10_digits().to_string(),
        Lit::Str(formula) if sign.is_none() => formula.value(),
        _ => return Err(refusal(span)),
    };
    Ok((format!("{minus}{digits}"), span))
}
