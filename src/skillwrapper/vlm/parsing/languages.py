"""With which words models judge in languages other than English.

Verdicts that a language writes without blanks, or bends by gender, are listed in the forms that
occur. A negation in front of a verdict turns it round; one behind it makes it two things
(``सही नहीं``), and then nothing is read.
"""

# ruff: noqa: RUF001, letters of other scripts are meant

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from typing import NamedTuple


class Language(NamedTuple):
    """Words of a language, separated by blanks; lower case.

    Attributes:
        true: "true", "yes", "correct", also with a copula where it is written in one.
        false: "false", "no", "incorrect".
        unsure: "unknown", "cannot be told".
        negation: "not" in front of a verdict; may be the word for "no".
        small: copulas and particles that may stand in front of a verdict.
        ending: copulas that may stand behind one.
        condition: "if", "whether".
        reason: "because", "since".
        link: "and", "or".
    """

    true: str
    false: str
    unsure: str = ""
    negation: str = ""
    small: str = ""
    ending: str = ""
    condition: str = ""
    reason: str = ""
    link: str = ""


LANGUAGES = {
    "Arabic": Language(
        true="نعم صحيح صحيحة صواب حقيقي",
        false="خطأ خاطئ خاطئة كاذب لا",
        unsure="مجهول",
        condition="إذا لو إن هل",
        reason="لأن لأنه لأنها",
        link="و أو",
    ),
    "Bengali": Language(
        true="সত্য সঠিক হ্যাঁ",
        false="মিথ্যা ভুল না",
        unsure="অনিশ্চিত অজানা",
        condition="যদি",
        reason="কারণ",
        link="এবং বা",
    ),
    "Chinese": Language(
        true="真 是 对 對 成立 正确 正確 为真 為真 是真 真的 是真的 属实 满足",
        false=(
            "假 否 错 錯 错误 錯誤 不成立 不正确 不正確 不是 不对 不對 为假 為假 "
            "是假 假的 是假的 不为真 不满足"
        ),
        unsure="不确定 不確定 未知 不明 不清楚 无法确定 無法確定 无法判断 無法判斷",
        negation="不",
        small="答案 结论 结论是 判断 答案是",
        condition="如果 若 假如 是否 只要 除非",
        reason="因为 因為 由于 由於",
        link="和 且 或 或者 与 及",
    ),
    "Czech": Language(
        true="pravda pravdivé ano správně",
        false="nepravda nepravdivé nesprávně",
        unsure="neznámé nejasné",
        small="je",
        condition="pokud jestli když",
        reason="protože",
        link="a nebo",
    ),
    "Dutch": Language(
        true="waar juist klopt",
        false="onwaar nee onjuist",
        unsure="onbekend onzeker onduidelijk",
        negation="niet",
        condition="als indien",
        reason="omdat want",
        link="en of",
    ),
    "Finnish": Language(
        true="tosi totta kyllä oikein",
        false="epätosi väärin ei",
        unsure="epävarma tuntematon",
        negation="ei",
        condition="jos",
        reason="koska",
        link="ja tai",
    ),
    "French": Language(
        true="vrai vraie oui exact exacte",
        false="faux fausse non inexact",
        unsure="inconnu inconnue incertain incertaine indéterminé indéterminée",
        negation="pas",
        small="est n'est c'est ce réponse",
        condition="si s'il quand",
        reason="car parce puisque selon",
        link="et ou",
    ),
    "German": Language(
        true="wahr ja richtig stimmt zutreffend",
        false="falsch nein unwahr unzutreffend",
        unsure="unbekannt unklar unsicher unbestimmt ungewiss",
        negation="nicht",
        small="ist antwort",
        condition="wenn falls ob sofern",
        reason="weil da denn laut",
        link="und oder",
    ),
    "Greek": Language(
        true="αληθές αληθής αληθεύει ναι σωστό",
        false="ψευδές ψευδής όχι λάθος",
        unsure="άγνωστο αβέβαιο",
        negation="δεν",
        small="είναι",
        condition="αν εάν",
        reason="επειδή γιατί",
        link="και ή",
    ),
    "Hebrew": Language(
        true="נכון אמת כן",
        false="שגוי שקר לא",
        negation="לא",
        condition="אם",
        reason="כי",
        link="או",
    ),
    "Hindi": Language(
        true="सही सत्य सच हाँ हां",
        false="गलत ग़लत असत्य झूठ नहीं",
        unsure="अनिश्चित अज्ञात अस्पष्ट",
        small="यह उत्तर",
        ending="है हैं",
        condition="अगर यदि",
        reason="क्योंकि",
        link="और या",
    ),
    "Hungarian": Language(
        true="igaz igen helyes",
        false="hamis nem helytelen",
        unsure="ismeretlen bizonytalan",
        negation="nem",
        small="ez",
        reason="mert mivel",
        link="és vagy",
    ),
    "Indonesian": Language(
        true="benar ya betul",
        false="salah tidak bukan",
        unsure="ragu",
        negation="tidak bukan",
        condition="jika kalau",
        reason="karena",
        link="dan atau",
    ),
    "Italian": Language(
        true="vero vera sì corretto corretta",
        false="falso falsa errato errata",
        unsure="sconosciuto incerto ignoto",
        negation="non",
        small="è risposta",
        condition="se quando",
        reason="perché poiché",
        link="e o oppure",
    ),
    "Japanese": Language(
        true="真 はい 正しい 真です は真 は真です 正しいです は正しい そうです",
        false=("偽 いいえ 偽です は偽 は偽です 正しくない 正しくありません 誤り 誤りです 違います"),
        unsure=(
            "不明 不明です わからない わかりません 分からない 分かりません "
            "判断できない 判断できません"
        ),
        small="答え 結論",
        condition="もし",
        reason="なぜなら",
        link="と または かつ",
    ),
    "Korean": Language(
        true="예 네 참 참입니다 참이다 참임 맞음 맞습니다 사실",
        false="아니요 아니오 거짓 거짓입니다 거짓이다 거짓임 틀림 틀립니다 아님",
        unsure="불확실 불확실함 불명 알수없음",
        small="는 은 이 가 답 결론",
        condition="만약 만일",
        reason="왜냐하면",
        link="그리고 또는 와 과",
    ),
    "Nordic": Language(
        true="sant sann sandt ja riktigt riktig rigtigt korrekt stämmer",
        false="falskt falsk nej nei usant osant osann usandt fel feil forkert",
        unsure="okänt osäkert ukjent usikkert ukendt usikker",
        negation="inte ikke",
        small="är er det",
        condition="om hvis",
        reason="eftersom fordi",
        link="och og eller",
    ),
    "Persian and Urdu": Language(
        true="درست بله صحیح ہاں سچ جی",
        false="نادرست خیر غلط نہیں جھوٹ",
        unsure="نامعلوم",
        ending="ہے است",
        condition="اگر",
        reason="زیرا چون کیونکہ",
        link="یا اور",
    ),
    "Polish": Language(
        true="tak prawda prawdziwe prawdziwy prawdą",
        false="nie fałsz fałszywe nieprawda nieprawdą",
        unsure="nieznane niepewne niejasne",
        negation="nie",
        small="jest odpowiedź",
        condition="jeśli jeżeli gdy",
        reason="ponieważ bo gdyż",
        link="i lub albo",
    ),
    "Romanian": Language(
        true="adevărat adevărată",
        false="fals falsă nu",
        unsure="necunoscut nesigur",
        negation="nu",
        small="este",
        condition="dacă",
        reason="deoarece pentru",
        link="și sau",
    ),
    "Russian": Language(
        true="да верно истина истинно правда верна",
        false="нет неверно ложь ложно неправда",
        unsure="неизвестно неясно",
        negation="не",
        small="это ответ",
        condition="если",
        reason="потому поскольку",
        link="и или",
    ),
    "Spanish and Portuguese": Language(
        true=(
            "verdadero verdadera cierto cierta correcto correcta sí sim verdadeiro "
            "verdadeira correto correta verdade verdad"
        ),
        false="falso falsa incorrecto incorrecta não errado errada incorreto",
        unsure="desconocido desconocida desconhecido desconhecida incierto incerto",
        negation="não",
        small="es é respuesta resposta",
        condition="si se cuando quando",
        reason="porque ya pues pois según",
        link="y o e ou",
    ),
    "Tamil and Telugu": Language(
        true="உண்மை ஆம் சரி నిజం అవును సరైనది",
        false="பொய் தவறு இல்லை అబద్ధం కాదు తప్పు",
    ),
    "Thai": Language(
        true="จริง ใช่ ถูกต้อง เป็นจริง",
        false="เท็จ ไม่ ไม่ใช่ ไม่จริง ผิด เป็นเท็จ",
        unsure="ไม่แน่ใจ ไม่ทราบ",
        negation="ไม่",
        condition="ถ้า หาก",
        reason="เพราะ",
        link="และ หรือ",
    ),
    "Turkish": Language(
        true="evet doğru",
        false="hayır hayir yanlış yanliş",
        unsure="belirsiz bilinmiyor",
        condition="eğer",
        reason="çünkü",
        link="ve veya",
    ),
    "Ukrainian": Language(
        true="так істина правильно вірно",
        false="ні хибно хибне неправильно невірно",
        unsure="невідомо",
        small="це",
        condition="якщо",
        reason="тому бо",
        link="і або",
    ),
    "Vietnamese": Language(
        true="có đúng",
        false="không sai",
        negation="không",
        condition="nếu",
        reason="vì",
        link="và hoặc",
    ),
}

# Inside of words of scripts that write vowels as marks, which ``\w`` does not hold.
MARKS_OF_SCRIPTS = (
    r"\u0300-\u036f\u0591-\u05c7\u0610-\u061a\u064b-\u065f\u0670\u0900-\u0963\u0966-\u0dff"
    r"\u0e00-\u0eff\u1000-\u109f\u1780-\u17ff"
)


def words_for(kind: str) -> frozenset[str]:
    """The words of one kind in all languages, in the form that lines are brought to."""
    return frozenset(_words(kind))


def _words(kind: str) -> Iterator[str]:
    for language in LANGUAGES.values():
        for word in getattr(language, kind).split():
            yield unicodedata.normalize("NFKC", word).casefold()
