"""Every sentence that a message is made of."""

from .mendings import MENDINGS
from .sayings import SAYINGS
from .text import Text

__all__ = ["PHRASES", "say"]

PHRASES = {
    # the head of a message
    "head": Text("{id}  {name}: not yet right.", "{id}  {name}：还不对。"),
    "cases": Text("Wrong in {wrong} of {all} cases. The first:", "{all} 组数据中错了 {wrong} 组。第一组："),
    "all wrong": Text("Tried on {all} random cases. The first:", "用 {all} 组随机数据检验。第一组："),
    "in result": Text("In {name}:", "在 {name} 中："),
    "slips": Text("Any one of these slips gives your numbers:", "你的数值等于犯下以下任一错误的结果："),
    "slip of several": Text("  - {title}. {why}", "  - {title}。{why}"),
    "like slip": Text(
        "Your numbers are those of this slip: {title}. {why}", "你的数值等于犯下这个错误的结果：{title}。{why}"
    ),
    "like number": Text("A slip that gives just this: {title}. {why}", "有一个错误恰好得到这样的结果：{title}。{why}"),
    "like slip in": Text(
        "For {name}, this slip gives what you have: {title}.",
        "就 {name} 而言，你的结果等于犯下这个错误的结果：{title}。",
    ),
    "transposed as well": Text(
        "Your {name} is your {other} transposed. Of the right ones neither is the other transposed.",
        "你的 {name} 是你的 {other} 的转置，而正确的两者并不互为转置。",
    ),
    "equal": Text(
        "Your numbers are those of a right solution but for this: {title}.",
        "你的数值等于正确解法只作如下改动的结果：{title}。",
    ),
    "equal in": Text(
        "Your result for {name} is that of a right solution but for this: {title}.",
        "你的 {name} 等于正确解法只作如下改动的结果：{title}。",
    ),
    "equal cases": Text(
        "They agree in all {all} cases. Your code may be written in another way: look for what does the same there.",
        "全部 {all} 组数据都吻合。你的写法可能不同：请在自己的代码中找出效果相同的地方。",
    ),
    "edit sign": Text("the sign of `{right}` is wrong", "`{right}` 的符号错了"),
    "edit left out": Text("`{right}` is left out", "漏掉了 `{right}`"),
    "edit after loop": Text("`{right}` stands after the loop, not in it", "`{right}` 放在了循环之后，而不在循环内"),
    "edit in loop": Text("`{right}` stands in the loop, not before it", "`{right}` 放在了循环内，而不在循环之前"),
    "edit summed": Text("`{right}` is added up", "`{right}` 被累加了"),
    "edit carried": Text(
        "`{right}` is kept as `{wrong}` for the next round", "`{right}` 以 `{wrong}` 之名留给了下一轮"
    ),
    "edit transposed": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit exchanged": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit halves": Text("`{wrong}` and `{right}` are exchanged", "`{wrong}` 与 `{right}` 互换了"),
    "edit name": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit instead": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit inserted": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit index": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit number": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit last": Text("only the last term of the sum `{right}` is kept", "求和 `{right}` 只保留了最后一项"),
    "edit diagonal": Text("only the diagonal of `{right}` is used", "只用了 `{right}` 的对角线"),
    "edit argument": Text("`{wrong}` in place of `{right}`", "`{right}` 写成了 `{wrong}`"),
    "edit result": Text(
        "`{wrong}` is returned in place of `{right}`, the right result", "返回了 `{wrong}`，而不是正确的结果 `{right}`"
    ),
    # where something is wrong
    "simplest": Text(
        "With {name} = {given}, {what} is {got}, and must be {right}.",
        "当 {name} = {given} 时，{what} 为 {got}，应为 {right}。",
    ),
    "on edge": Text(
        "Every case that it judges wrongly lies exactly on an edge: `<` and `<=` differ only there.",
        "判断错误的每一组数据都恰好在边界上：`<` 与 `<=` 只在那里有区别。",
    ),
    "near edge": Text(
        "Every case that it judges wrongly lies very near an edge: a tolerance, where the edge itself is asked for?",
        "判断错误的每一组数据都离边界极近：是不是加了容差，而题目要求以边界本身为准？",
    ),
    "all zero": Text(
        "Every case that it judges wrongly has {what} = 0, and no other case has.",
        "判断错误的每一组数据都有 {what} = 0，其余各组都不是这样。",
    ),
    "zero wrong": Text("Every case in which it is wrong has {what} = 0.", "每一组出错的数据都有 {what} = 0。"),
    "zero right": Text(
        "It is right in the cases with {what} = 0, and in no other.", "只有 {what} = 0 的各组数据正确，其余各组都出错。"
    ),
    "whole numbers": Text(
        "It is wrong only where arguments are whole numbers. An array made of them, or after their pattern (`x.copy()`,"
        " `np.zeros_like(x)`, `np.array([0, 0, m])`), holds whole numbers and loses the digits after the point. Make"
        " arrays of floats: `np.array(x, float)`, `np.zeros(3)`.",
        "只有参数是整数时才出错。由整数建立或按其样式建立的数组"
        "（`x.copy()`、`np.zeros_like(x)`、`np.array([0, 0, m])`）只能存放整数，小数部分会丢失。"
        "请用浮点数组：`np.array(x, float)`、`np.zeros(3)`。",
    ),
    "first line": Text(
        "Line {line}, `{text}`, computes what no right solution known here has: it may only be another way, or be"
        " wrong. Look at it, at what it uses and at what follows.",
        "第 {line} 行 `{text}` 算出了在这里已知的各正确解法中都找不到的值：也许只是另一种做法，也许错了。"
        "请检查它、它用到的量以及它之后的部分。",
    ),
    "it shows": Text("In this case it shows in the result:", "在这组数据中反映为："),
    "first wrong": Text(
        "In the package's own solution this slip makes {wrong} wrong first. These stay right for every body: {right}.",
        "在本包的参考解答中犯这个错误，最先出错的是 {wrong}。对每个刚体仍都正确的有：{right}。",
    ),
    "wrong first": Text(
        "In the package's own solution this slip makes {wrong} wrong first.",
        "在本包的参考解答中犯这个错误，最先出错的是 {wrong}。",
    ),
    "in line": Text("{title}, in its line `{statement}`", "在其 `{statement}` 一行中，{title}"),
    "results exchanged": Text("{first} and {second} are exchanged", "{first} 与 {second} 互换了"),
    "exchanged": Text("Each of them is right: return them in the other order.", "二者都正确，只是返回的顺序反了。"),
    "order of these": Text("put in order what is returned: {which}", "调整返回各项的顺序：{which}"),
    "other order": Text("what is returned must stand in the other order", "返回的各项要换一个顺序"),
    "where": Text(
        "Read {section}; ask for a hint: twistwrench exercises hint {id}",
        "参阅 {section}；需要提示：twistwrench exercises hint {id}",
    ),
    "arrays": Text("list of {n} arrays", "{n} 个数组的列表"),
    "project": Text("the project at the end of the chapter", "章末的累积项目"),
    "no slip": Text(
        "It is not one of the known slips. In this case the comparison shows:",
        "不属于已知的典型错误。这组数据的比较结果：",
    ),
    "broken": Text(
        "This holds for every right answer, but not for yours: {text}", "正确答案都满足而你的不满足：{text}"
    ),
    "broken elsewhere": Text(
        "This holds for every right answer, but not in each case for yours: {text}",
        "正确答案都满足，而你的答案并非在每组数据中都满足：{text}",
    ),
    # why an answer cannot be compared
    "stopped": Text("It stopped with {error}", "运行出错：{error}"),
    "at line": Text("in {file}, line {line}:", "位于 {file} 第 {line} 行："),
    "none": Text("It returned None. Is the `return` missing?", "返回了 None。是不是漏了 `return`？"),
    "pieces": Text(
        "It must return {n} things, in this order: {names}. It returned {got}.",
        "应按顺序返回 {n} 个量：{names}。实际返回 {got}。",
    ),
    "not numbers": Text("{name} must be {what}, not {got}.", "{name} 应为{what}，而不是 {got}。"),
    "raises": Text("{name} raises {error}, and must be {what}.", "{name} 引发了 {error}，而它应为{what}。"),
    "numbers": Text("numbers", "数值"),
    "truth values": Text("True or False", "True 或 False"),
    "words": Text("a string", "字符串"),
    "shape": Text("{name} has the shape {got}; it must be {expected}.", "{name} 的形状是 {got}，应为 {expected}。"),
    "nan": Text("{name} has entries that are not finite numbers: {where}.", "{name} 含有不是有限数的元素：{where}。"),
    "changed": Text(
        "It changes its argument `{name}`. Work on a copy: the caller still needs it.",
        "它修改了参数 `{name}`。请在副本上运算，调用者还要用它。",
    ),
    "changed term": Text(
        "A sum or a difference changes one of its two terms, which is still needed. Make a new object with a new array:"
        " `a + b` is one; `a += b` changes the array of `a`, and `c = a` is only another name for it.",
        "求和或求差时改变了其中一个操作数，而它之后还要用。请新建一个对象和它的数组：`a + b` 会新建数组，"
        "`a += b` 改变的是 `a` 的数组，而 `c = a` 只是同一个对象的另一个名称。",
    ),
    "kept": Text(
        "Called again with the same arguments, it returns something else: it keeps something from one call to the next."
        " What a call changes must be made in it; a default like `out=[]` is made only once, for all calls.",
        "用相同的参数再调用一次，返回的却不一样：它把某些内容从一次调用留到了下一次。"
        "会被修改的量要在函数内新建；`out=[]` 这样的默认值只生成一次，所有调用共用。",
    ),
    "one array": Text(
        "The numbers are right, but two of the things that it returns are one and the same array: compute each.",
        "数值正确，但它返回的量中有两个是同一个数组：请分别计算。",
    ),
    "returned before": Text(
        "It returns the same array as in an earlier call, with other arguments: it keeps something from one call to"
        " the next. Make what it returns anew in each call.",
        "参数不同，它返回的却是以前某次调用的同一个数组：它把某些内容从一次调用留到了下一次。返回的量每次都要新建。",
    ),
    "missing": Text("There is no function {name} in {file} any more.", "{file} 中已没有函数 {name}。"),
    "not a function": Text("{name} in {file} is not a function any more.", "{file} 中的 {name} 已不是函数。"),
    "endless": Text(
        "It did not finish in {seconds} s: a loop that never ends?", "{seconds} 秒内没有结束：是不是死循环？"
    ),
    "ended": Text("It ended the whole Python process.", "它使整个 Python 进程终止了。"),
    "ended in": Text(
        "{name} does so if it is given the number of a joint or frame that the model does not have: print the number.",
        "把模型中没有的关节或坐标系的编号交给 {name}，它就会这样：请打印这个编号。",
    ),
    "encoding": Text(
        "{file} is not written in UTF-8: save it as UTF-8 in your editor. ({error})",
        "{file} 不是 UTF-8 编码：请在编辑器中另存为 UTF-8。（{error}）",
    ),
    "file": Text("{file} cannot be read: {error}", "无法读取 {file}：{error}"),
    "file at line": Text("{file}, line {line} cannot be read: {error}", "{file} 第 {line} 行无法读取：{error}"),
    "no file": Text(
        "{file} is not there: `twistwrench exercises start` brings it back.",
        "缺少 {file}：用 `twistwrench exercises start` 可重新生成。",
    ),
    "needs": Text(
        "It needs the package {name}, which is not installed here; `pip install pin` brings Pinocchio.",
        "需要 {name}，此处没有安装；`pip install pin` 可安装 Pinocchio。",
    ),
    "words missing": Text(
        "The function is right. Now explain it in words: fill in {name}.", "函数已正确。请再用文字作答：填写 {name}。"
    ),
    "words short": Text("{name} is very short: a sentence or two, please.", "{name} 太短：请写一两句话。"),
    # the kinds of exercises
    "code": Text("code", "编程"),
    "number": Text("number", "计算"),
    "explain": Text("explain", "解释"),
    "prove": Text("prove", "证明"),
    **SAYINGS,
    **MENDINGS,
    # what shows in all cases together
    "fixed size": Text(
        "{name} has the shape {shape} in all cases: the sizes of one robot are written into the function.",
        "在所有情形中 {name} 的形状都是 {shape}：函数里写死了某个机器人的尺寸。",
    ),
    "cut off": Text(
        "{name} has lost the digits after the point: it is written into an array of whole numbers."
        " Make that array of floats, as `np.zeros(n)` is.",
        "{name} 的小数部分丢失了：它被写进了整数数组。请用浮点数组，例如 `np.zeros(n)`。",
    ),
    # how an entry or a block compares
    "whole": Text("{name}", "{name}"),
    "block": Text("{name}, {block}", "{name}，{block}"),
    "is": Text("{what}: {relation}", "{what}：{relation}"),
    "others right": Text("the rest of {name} is right", "{name} 的其余部分正确"),
    "right": Text("right", "正确"),
    "zero": Text("zero, and must not be", "为零，不应为零"),
    "not zero": Text("must be zero", "应为零"),
    "sign": Text("the sign is wrong", "符号相反"),
    "transposed": Text("transposed", "被转置"),
    "transposed sign": Text("transposed, and the sign is wrong", "被转置且符号相反"),
    "factor": Text("too large by a factor of {factor:.4g}", "是正确值的 {factor:.4g} 倍"),
    "divisor": Text("too small by a factor of {factor:.4g}", "只有正确值的 1/{factor:.4g}"),
    "unsorted": Text("the right numbers, but not in ascending order", "数值正确，但没有按升序排列"),
    "falls": Text("not in ascending order", "没有按升序排列"),
    "early": Text("the right numbers, one place too early", "数值正确，但都提前了一位"),
    "late": Text("the right numbers, one place too late", "数值正确，但都推后了一位"),
    "permuted": Text("the right numbers, in the wrong places", "数值正确，位置不对"),
    "signs": Text("the right numbers, some with the wrong sign", "数值正确，部分符号错误"),
    "upper": Text("only the upper triangle is right", "只有上三角正确"),
    "lower": Text("only the lower triangle is right", "只有下三角正确"),
    "diagonal": Text("only the diagonal is right", "只有对角线正确"),
    "off diagonal": Text("right except on the diagonal", "除对角线外正确"),
    "entries": Text("wrong in {entries}, right elsewhere", "错在 {entries}，其余正确"),
    "rows": Text("wrong in rows {lines}, right in the others", "第 {lines} 行有错，其余各行正确"),
    "columns": Text("wrong in columns {lines}, right in the others", "第 {lines} 列有错，其余各列正确"),
    "some": Text("{wrong} of {all} entries are wrong", "{all} 个元素中有 {wrong} 个错误"),
    "only where": Text(
        "It is right where {name} = {value}: look at what you do with {name}.",
        "当 {name} = {value} 时结果正确：请检查你对 {name} 的处理。",
    ),
    "not used": Text(
        "In this case {name} does not change with {what}, and must.",
        "在这组数据中，{what} 改变时 {name} 不变，而它应当改变。",
    ),
    "diagonal only": Text(
        "It is right where {name} is diagonal: look at what you do with what stands beside the diagonal.",
        "当 {name} 为对角矩阵时结果正确：请检查你对非对角元素的处理。",
    ),
    "unturned only": Text(
        "It is right where nothing in {name} is turned against its parent: look at what you do with the rotation.",
        "当 {name} 中没有转动时结果正确：请检查你对旋转的处理。",
    ),
    "inexact": Text("right to {digits} digits only", "只有 {digits} 位正确"),
    "approximation": Text("nearly right in all cases: an approximation?", "在所有情形中都近似正确：是不是用了近似？"),
    "near the largest": Text("off by less than 10 % of the largest entry", "偏差不到最大元素的 10%"),
    "nearly": Text("{found}, to about 5 digits", "{found}（约准到 5 位）"),
    "too large": Text("too large", "偏大"),
    "too small": Text("too small", "偏小"),
    "here": Text("{relation} here", "此处{relation}"),
    "here, nearly": Text("{relation} here, by less than 10 %", "此处{relation}，偏差不到 10%"),
    "in all wrong": Text("{relation} in all cases in which it is wrong", "在它出错的各组数据中都{relation}"),
    "different": Text("different numbers", "数值不同"),
    "false": Text("is {got}, and must be {right}", "是 {got}，应为 {right}"),
    "too strict": Text(
        "It is too strict: it returns False in {strict} cases that are True, and never True where it must not.",
        "判断过严：有 {strict} 组应为 True 却给出 False，而没有一组相反。",
    ),
    "too loose": Text(
        "It is too loose: it returns True in {loose} cases that are False, and never False where it must not.",
        "判断过宽：有 {loose} 组应为 False 却给出 True，而没有一组相反。",
    ),
    "both ways": Text(
        "It is wrong in both directions: it returns False in {strict} cases that are True, and True in {loose} that"
        " are False.",
        "两个方向都有错：有 {strict} 组应为 True 却给出 False，有 {loose} 组应为 False 却给出 True。",
    ),
    "text differs": Text("{got}, where a different text is expected", "得到 {got}，应为另一段文字"),
}


def say(phrase: str, **values: object) -> Text:
    """Return a phrase with its braces filled."""
    return PHRASES[phrase].fill(**values)
